#include "service/cli/environment.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>
#include <string_view>
#include <unistd.h>
#include <vector>

namespace farhorizon {

namespace {

// What the program reads itself, what the system's supervisor hands to it, and what the C library,
// the loader and the sanitizers read. No HOME: GDAL and PROJ look for files of the user's there.
constexpr std::array<std::string_view, 12> kNames = {
    "PATH",    "LANG",     "LANGUAGE",      "TERM",          "TZ",           "TMPDIR",
    "COLUMNS", "NO_COLOR", "NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID", "JOURNAL_STREAM"};
// By which S3Location and S3Credentials find a bucket.
constexpr std::array<std::string_view, 9> kOfBuckets = {
    "AWS_ENDPOINT_URL_S3", "AWS_ENDPOINT_URL",  "AWS_REGION",
    "AWS_DEFAULT_REGION",  "AWS_ACCESS_KEY_ID", "AWS_SECRET_ACCESS_KEY",
    "AWS_SESSION_TOKEN",   "AWS_PROFILE",       "AWS_SHARED_CREDENTIALS_FILE"};
constexpr std::array<std::string_view, 9> kPrefixes = {
    "FARHORIZON_", "LC_", "LD_", "MALLOC_", "GLIBC_TUNABLES", "ASAN_", "UBSAN_", "LSAN_", "TSAN_"};

bool IsKnown(std::string_view name) {
  return std::ranges::find(kNames, name) != kNames.end() ||
         std::ranges::find(kOfBuckets, name) != kOfBuckets.end() ||
         std::ranges::any_of(kPrefixes, [name](auto prefix) { return name.starts_with(prefix); });
}

}  // namespace

void KeepOnlyKnownEnvironment() {
  std::vector<std::string> unknown;
  for (char** entry = environ; entry != nullptr && *entry != nullptr; ++entry) {
    const std::string_view variable = *entry;
    const std::string_view name = variable.substr(0, variable.find('='));
    if (!IsKnown(name)) unknown.emplace_back(name);
  }
  // NOLINTNEXTLINE(concurrency-mt-unsafe): there is one thread
  for (const std::string& name : unknown) ::unsetenv(name.c_str());
}

}  // namespace farhorizon

#include "service/cli/client_key.h"

#include <cstdio>
#include <cstdlib>
#include <utility>

#include "core/io/file.h"
#include "service/auth/api_key.h"
#include "service/http/server.h"

namespace farhorizon {

namespace {

constexpr const char* kVariable = "FARHORIZON_KEY";
constexpr std::uintmax_t kLargestFile = 4096;

Result<std::string> KeyIn(std::string text, const std::string& where) {
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r' || text.back() == ' ')) {
    text.pop_back();
  }
  if (IdOfKey(text)) return text;
  return Error{ErrorCode::kInvalidArgument,
               where + " has no key; a key is what `farhorizon keys add` prints, fh_…"};
}

}  // namespace

Result<std::string> ReadClientKey(const std::string& file, const ServiceUrl& url) {
  Result<std::string> key = std::string();
  if (!file.empty()) {
    Result<std::string> text = ReadFile(file, kLargestFile);
    if (!text) return std::move(text.error()).WithContext("the key");
    key = KeyIn(*std::move(text), file);
  } else if (const char* value = std::getenv(kVariable)) {  // NOLINT(concurrency-mt-unsafe)
    key = KeyIn(value, kVariable);
  }
  if (key && !key->empty() && !IsLoopback(url.host)) {
    std::fprintf(stderr,
                 "farhorizon: the key goes to %s without encryption; see TLS in "
                 "service/OPERATING.md\n",
                 url.host.c_str());
  }
  return key;
}

}  // namespace farhorizon

#include "service/process_info.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <sys/resource.h>
#include <system_error>
#include <unistd.h>

namespace farhorizon {

namespace {

std::string TextOf(const char* path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

double SecondsOf(const struct timeval& time) {
  return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
}

// The field of that number, from 0, in /proc/self/stat behind the name of the program [proc(5)].
double StatField(const std::string& stat, int number) {
  std::size_t at = stat.rfind(')');
  for (int i = 0; at != std::string::npos && i < number; ++i) at = stat.find(' ', at + 1);
  return at == std::string::npos ? 0 : std::strtod(stat.c_str() + at + 1, nullptr);
}

// When the machine started, in seconds since 1970.
double BootTime() {
  const std::string stat = TextOf("/proc/stat");
  const std::size_t at = stat.find("btime ");
  return at == std::string::npos ? 0 : std::strtod(stat.c_str() + at + 6, nullptr);
}

std::int64_t OpenFiles() {
  std::error_code failure;
  const std::filesystem::directory_iterator files("/proc/self/fd", failure);
  return failure ? 0 : std::distance(begin(files), end(files)) - 1;  // one is the iterator's own
}

}  // namespace

ProcessInfo ReadProcessInfo() {
  ProcessInfo info;
  struct rusage usage {};
  if (::getrusage(RUSAGE_SELF, &usage) == 0) {
    info.cpu_seconds = SecondsOf(usage.ru_utime) + SecondsOf(usage.ru_stime);
  }
  // Fields 22 and 24 of proc(5), which counts from 1: the start in ticks, and pages.
  const std::string stat = TextOf("/proc/self/stat");
  info.start_seconds =
      BootTime() + StatField(stat, 20) / static_cast<double>(::sysconf(_SC_CLK_TCK));
  info.resident_bytes = static_cast<std::int64_t>(StatField(stat, 22)) * ::sysconf(_SC_PAGESIZE);
  info.open_files = OpenFiles();
  struct rlimit limit {};
  if (::getrlimit(RLIMIT_NOFILE, &limit) == 0) {
    info.most_files = static_cast<std::int64_t>(limit.rlim_cur);
  }
  return info;
}

}  // namespace farhorizon

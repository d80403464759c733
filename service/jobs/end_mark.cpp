#include "service/jobs/end_mark.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <fstream>
#include <signal.h>
#include <sstream>
#include <string>
#include <unistd.h>

namespace farhorizon {

namespace {

constexpr std::string_view kOrderlyWord = "orderly\n";
constexpr std::string_view kCrashedWord = "crashed\n";
constexpr std::string_view kRunningWord = "running ";
constexpr std::array kFatalSignals = {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL};

std::atomic<int> marked_lock{-1};
std::atomic<pid_t> marking_process{-1};
std::array<struct sigaction, kFatalSignals.size()> earlier_actions{};

std::string FirstWord(const char* path) {
  std::ifstream file(path);
  std::string word;
  file >> word;
  return word;
}

// What tells this run of the machine, and how many processes it has ended for want of memory.
std::string MachineMark() {
  std::ifstream counts("/proc/vmstat");
  std::string name;
  std::string value;
  while (counts >> name >> value && name != "oom_kill") {
  }
  return FirstWord("/proc/sys/kernel/random/boot_id") + " " + (name == "oom_kill" ? value : "0");
}

void Write(int lock, std::string_view mark) {
  [[maybe_unused]] const ssize_t written = ::pwrite(lock, mark.data(), mark.size(), 0);
}

std::string Read(int lock) {
  std::string text(256, '\0');
  const ssize_t size = ::pread(lock, text.data(), text.size(), 0);
  text.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
  return text;
}

// Async-signal-safe.
void OnFatalSignal(int signal) {
  const int cause = errno;
  // A child that was forked and not yet given its own handlers is another process.
  if (::getpid() == marking_process) Write(marked_lock, kCrashedWord);
  errno = cause;
  for (std::size_t i = 0; i < kFatalSignals.size(); ++i) {
    if (kFatalSignals[i] == signal) ::sigaction(signal, &earlier_actions[i], nullptr);
  }
  ::raise(signal);  // delivered when this handler returns
}

}  // namespace

PreviousEnd ReadEndMark(int lock) {
  const std::string mark = Read(lock);
  if (mark.starts_with(kOrderlyWord)) return PreviousEnd::kOrderly;
  if (mark.starts_with(kCrashedWord)) return PreviousEnd::kCrashed;
  if (!mark.starts_with(kRunningWord)) return PreviousEnd::kKilled;  // of an earlier version
  std::istringstream words(mark.substr(kRunningWord.size()));
  std::istringstream current(MachineMark());
  std::string boot;
  std::string boot_now;
  long long kills = 0;
  long long kills_now = 0;
  words >> boot >> kills;
  current >> boot_now >> kills_now;
  return boot == boot_now && kills_now > kills ? PreviousEnd::kCrashed : PreviousEnd::kKilled;
}

void MarkRunning(int lock) {
  const std::string mark = std::string(kRunningWord) + MachineMark() + "\n";
  if (Read(lock).starts_with(mark)) return;
  Write(lock, mark);
}

void MarkOrderly(int lock) { Write(lock, kOrderlyWord); }

void MarkFatalSignals(int lock) {
  marked_lock = lock;
  marking_process = ::getpid();
  struct sigaction action {};
  action.sa_handler = OnFatalSignal;
  for (std::size_t i = 0; i < kFatalSignals.size(); ++i) {
    ::sigaction(kFatalSignals[i], &action, &earlier_actions[i]);
  }
}

}  // namespace farhorizon

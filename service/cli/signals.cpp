#include "service/cli/signals.h"

#include <ctime>
#include <pthread.h>
#include <signal.h>
#include <unistd.h>

namespace farhorizon {

namespace {

sigset_t StopSignals() {
  sigset_t set;
  ::sigemptyset(&set);
  ::sigaddset(&set, SIGINT);
  ::sigaddset(&set, SIGTERM);
  return set;
}

sigset_t ServiceSignals() {
  sigset_t set = StopSignals();
  ::sigaddset(&set, SIGHUP);
  ::sigaddset(&set, SIGUSR1);
  ::sigaddset(&set, SIGUSR2);
  return set;
}

void Block(const sigset_t& set) {
  ::pthread_sigmask(SIG_BLOCK, &set, nullptr);
  ::signal(SIGPIPE, SIG_IGN);
  ::signal(SIGXFSZ, SIG_IGN);  // a write beyond RLIMIT_FSIZE then fails as on a full disk
}

}  // namespace

void BlockSignals() { Block(StopSignals()); }

void BlockServiceSignals() { Block(ServiceSignals()); }

bool IsStopSignal(int signal) { return signal == SIGINT || signal == SIGTERM; }

std::optional<int> WaitForSignal(std::chrono::milliseconds most) {
  const sigset_t set = ServiceSignals();
  struct timespec time {};
  time.tv_sec = static_cast<std::time_t>(most.count() / 1000);
  time.tv_nsec = static_cast<decltype(time.tv_nsec)>((most.count() % 1000) * 1'000'000);
  const int signal = ::sigtimedwait(&set, nullptr, &time);
  if (signal > 0) return signal;
  return std::nullopt;
}

StopOnSignal::StopOnSignal() {
  BlockSignals();
  thread_ = std::thread([this] {
    const sigset_t set = StopSignals();
    int signal = 0;
    while (::sigwait(&set, &signal) == 0 && !ending_) {
      if (!source_.request_stop()) ::_exit(130);
    }
  });
}

StopOnSignal::~StopOnSignal() {
  ending_ = true;
  // The thread is in sigwait, so SIGTERM ends no thread but wakes this one.
  // NOLINTNEXTLINE(bugprone-bad-signal-to-kill-thread)
  ::pthread_kill(thread_.native_handle(), SIGTERM);
  thread_.join();
}

}  // namespace farhorizon

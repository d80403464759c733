#pragma once

#include <atomic>
#include <chrono>
#include <optional>
#include <stop_token>
#include <thread>

namespace farhorizon {

/// Blocks SIGINT and SIGTERM in this thread and in those that it starts later; ignores SIGPIPE
/// and SIGXFSZ.
void BlockSignals();

/// The same, and SIGHUP, SIGUSR1 and SIGUSR2, so that none of them ends a service.
void BlockServiceSignals();

/// Waits for a signal that BlockServiceSignals blocks and returns it; nullopt if none comes within
/// `most`.
std::optional<int> WaitForSignal(std::chrono::milliseconds most);

/// Whether the signal is SIGINT or SIGTERM.
bool IsStopSignal(int signal);

/// While this object lives, the first SIGINT or SIGTERM becomes a stop request, and the second ends
/// the program at once.
class StopOnSignal {
 public:
  StopOnSignal();
  ~StopOnSignal();
  StopOnSignal(const StopOnSignal&) = delete;
  StopOnSignal& operator=(const StopOnSignal&) = delete;

  [[nodiscard]] std::stop_token token() const { return source_.get_token(); }

 private:
  std::stop_source source_;
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

}  // namespace farhorizon

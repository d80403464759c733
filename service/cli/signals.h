#pragma once

#include <atomic>
#include <chrono>
#include <optional>
#include <stop_token>
#include <thread>

namespace farhorizon {

/// Takes SIGINT and SIGTERM away from their defaults, in this thread and those it starts later.
void HoldSignals();

/// The next SIGINT or SIGTERM that is held; nullopt where none comes within `most`.
std::optional<int> NextSignal(std::chrono::milliseconds most);

/// Turns the first SIGINT or SIGTERM into a stop request, for as long as this lives; the second ends
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

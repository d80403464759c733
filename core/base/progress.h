#pragma once

#include <functional>
#include <stop_token>

namespace farhorizon {

/// Where long work says how far it is: a stage by name and the share of it that is done, in [0, 1].
/// Called from the thread that does the work, at most some hundred times a stage.
using Progress = std::function<void(const char* stage, double done)>;

/// How a caller watches long work and stops it. Both may be left empty.
struct Watch {
  Progress progress = {};
  std::stop_token stop = {};

  void Report(const char* stage, double done) const {
    if (progress) progress(stage, done);
  }
  [[nodiscard]] bool StopRequested() const { return stop.stop_requested(); }
};

}  // namespace farhorizon

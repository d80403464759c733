#pragma once

#include <chrono>
#include <optional>

#include "core/base/run_control.h"

namespace farhorizon {

/// Measures how long each stage of watched work takes, by listening to its progress.
class StageTimer {
 public:
  /// A progress that keeps time and passes on to `next`. Requires: this outlives it.
  Progress Listen(Progress next) {
    return [this, next = std::move(next)](Stage stage, double done) {
      if (stage_ != stage) Enter(stage);
      if (next) next(stage, done);
    };
  }

  /// Seconds by stage, the present one up to now.
  StageSeconds Seconds() {
    if (stage_) Enter(*stage_);
    return seconds_;
  }

 private:
  using Clock = std::chrono::steady_clock;

  void Enter(Stage stage) {
    const Clock::time_point now = Clock::now();
    if (stage_) seconds_[StageName(*stage_)] += std::chrono::duration<double>(now - since_).count();
    stage_ = stage;
    since_ = now;
  }

  std::optional<Stage> stage_;
  Clock::time_point since_ = Clock::now();
  StageSeconds seconds_;
};

}  // namespace farhorizon

#pragma once

#include <cmath>
#include <functional>
#include <map>
#include <stop_token>
#include <string>

#include "core/base/assumption.h"
#include "core/base/stage.h"

namespace farhorizon {

/// Takes how far long work is: a stage and the share of it that is done, in [0, 1]. That share
/// never falls within a stage; stages may alternate.
/// Called from the thread that does the work, at most some hundred times a stage. It is copied
/// (RunControl::Between): what it remembers from call to call must be shared by its copies.
using Progress = std::function<void(Stage stage, double done)>;

/// Takes a sentence that the caller should know although the work goes on. Called as Progress is.
using WarningHandler = std::function<void(const std::string& text)>;

/// Takes what was assumed about the data. Called as Progress is, once for each assumption.
using AssumptionHandler = std::function<void(const Assumption&)>;

/// Seconds that the work has spent in each stage so far, by the stage's name.
using StageSeconds = std::map<std::string, double>;

/// How a caller watches long work and stops it. All may be left empty.
struct RunControl {
  Progress progress = {};
  std::stop_token stop = {};
  WarningHandler on_warning = {};
  AssumptionHandler on_assumption = {};
  /// The times of a caller who wants them in what is written; the work itself has no clock.
  std::function<StageSeconds()> timings = {};

  void Report(Stage stage, double done) const {
    if (progress) progress(stage, done);
  }
  /// The control for work that is only a piece of each stage that it reports: its 0 is `from` of
  /// the stage, its 1 is `to`.
  [[nodiscard]] RunControl Between(double from, double to) const {
    RunControl piece = *this;
    if (progress) {
      piece.progress = [whole = progress, from, to](Stage stage, double done) {
        whole(stage, std::lerp(from, to, done));
      };
    }
    return piece;
  }
  [[nodiscard]] StageSeconds Timings() const { return timings ? timings() : StageSeconds(); }
  void Warn(const std::string& text) const {
    if (on_warning) on_warning(text);
  }
  void Assume(const Assumption& assumption) const {
    if (on_assumption) on_assumption(assumption);
  }
  [[nodiscard]] bool StopRequested() const { return stop.stop_requested(); }
};

}  // namespace farhorizon

#pragma once

#include <functional>
#include <stop_token>
#include <string>

namespace farhorizon {

/// Where long work says how far it is: a stage by name and the share of it that is done, in [0, 1].
/// Called from the thread that does the work, at most some hundred times a stage.
using Progress = std::function<void(const char* stage, double done)>;

/// Where work says what its caller should know although it goes on: a sentence. Called as Progress is.
using Notice = std::function<void(const std::string& text)>;

/// How a caller watches long work and stops it. All may be left empty.
struct Watch {
  Progress progress = {};
  std::stop_token stop = {};
  Notice notice = {};

  void Report(const char* stage, double done) const {
    if (progress) progress(stage, done);
  }
  void Tell(const std::string& text) const {
    if (notice) notice(text);
  }
  [[nodiscard]] bool StopRequested() const { return stop.stop_requested(); }
};

}  // namespace farhorizon

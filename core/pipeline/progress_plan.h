#pragma once

#include <array>
#include <span>

#include "core/base/stage.h"

namespace farhorizon {

/// The runs that report progress. A job is kBuild.
enum class Workflow { kBuild, kHorizon, kKineticHorizon, kSkyline, kVerify, kTrace, kCompare };

inline constexpr std::array kWorkflows = {
    Workflow::kBuild,  Workflow::kHorizon, Workflow::kKineticHorizon, Workflow::kSkyline,
    Workflow::kVerify, Workflow::kTrace,   Workflow::kCompare};

/// A stage of a run and its part of the run's time.
struct StageShare {
  Stage stage;
  double share;
};

/// The stages of a run in the order in which they first report. The shares are positive and add up
/// to 1.
std::span<const StageShare> PlanOf(Workflow workflow);

/// How much of one run is done. Each stage adds its share times what is done of it, so that the sum
/// rises where stages alternate, too: a build encodes and measures level after level.
class OverallProgress {
 public:
  explicit OverallProgress(Workflow workflow) : plan_(PlanOf(workflow)) {}

  /// Takes one report and returns the percentage so far, from 0 to 99: the work is done only when
  /// its caller says so. The percentage never falls, whatever is reported; a stage outside the plan
  /// adds nothing.
  int Percent(Stage stage, double done);

 private:
  std::span<const StageShare> plan_;
  std::array<double, kStages.size()> done_{};
};

}  // namespace farhorizon

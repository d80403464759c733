#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/base/run_control.h"
#include "core/pipeline/progress_plan.h"

namespace farhorizon {

/// One call of a Progress.
struct ProgressReport {
  Stage stage;
  double done;
};

/// A progress that appends every report to `reports`, which must outlive it.
inline Progress RecordInto(std::vector<ProgressReport>& reports) {
  return [&reports](Stage stage, double done) { reports.push_back({stage, done}); };
}

/// What is wrong with the reports of a whole run, a line each; empty where they keep to the plan:
/// every stage of it and no other, first reported in its order, each from about 0 up to 1 without a
/// fall. The sum of the shares is taken from the reports as they are, so that nothing hides a fall.
inline std::vector<std::string> OffencesAgainstPlan(Workflow workflow,
                                                    const std::vector<ProgressReport>& reports) {
  std::vector<std::string> offences;
  const std::span<const StageShare> plan = PlanOf(workflow);
  std::array<double, kStages.size()> done{};
  std::vector<Stage> order;
  const auto sum = [&plan, &done] {
    double total = 0;
    for (const StageShare& s : plan) total += s.share * done[static_cast<std::size_t>(s.stage)];
    return total;
  };
  double before = 0;
  for (const ProgressReport& report : reports) {
    const std::string what = StageName(report.stage) + (" " + std::to_string(report.done));
    double& of_stage = done[static_cast<std::size_t>(report.stage)];
    if (!(report.done >= 0 && report.done <= 1)) offences.push_back(what + " is no share");
    if (report.done < of_stage) {
      offences.push_back(what + " falls from " + std::to_string(of_stage));
    }
    if (std::find(order.begin(), order.end(), report.stage) == order.end()) {
      order.push_back(report.stage);
    }
    of_stage = report.done;
    // Sums of the same numbers differ by rounding alone.
    if (sum() < before - 1e-12) offences.push_back(what + " makes the whole fall");
    before = sum();
    if (&report == &reports.front() && before > 0.02) offences.push_back("starts late");
  }
  std::vector<Stage> planned;
  for (const StageShare& s : plan) {
    planned.push_back(s.stage);
    const double end = done[static_cast<std::size_t>(s.stage)];
    if (end != 1) offences.push_back(std::string(StageName(s.stage)) + " ends before 1");
  }
  if (order != planned) {
    std::string stages = "not the planned stages, or in another order:";
    for (const Stage stage : order) stages.append(" ").append(StageName(stage));
    offences.push_back(stages);
  }
  return offences;
}

}  // namespace farhorizon

#include "core/pipeline/progress_plan.h"

#include <algorithm>
#include <cstddef>

namespace farhorizon {

namespace {

// Shares of wall time on one thread: means of three DEMs, the Jacksboro fault of tests/data, the
// White Mountains (1201 x 1201 posts at 79 m) and the Gabilan lidar (921 x 859 posts at 1 m); a
// trace, half way down the heights, is the mean of the first two. Shares above a tenth differ
// between the DEMs by a factor of up to 2.6, that of kDecide in the kinetic run by 4.4. Any shares
// are sound; these make the percentage rise about as time passes.
constexpr StageShare kBuild[] = {{Stage::kRead, 0.02},         {Stage::kSweep, 0.005},
                                 {Stage::kCandidates, 0.005},  {Stage::kDecide, 0.01},
                                 {Stage::kSimplify, 0.515},    {Stage::kEncode, 0.02},
                                 {Stage::kMeasure, 0.25},      {Stage::kLinesOfSight, 0.05},
                                 {Stage::kEdgeMeasures, 0.12}, {Stage::kWrite, 0.005}};
constexpr StageShare kHorizon[] = {{Stage::kRead, 0.01},         {Stage::kSweep, 0.03},
                                   {Stage::kCandidates, 0.03},   {Stage::kDecide, 0.08},
                                   {Stage::kLinesOfSight, 0.29}, {Stage::kEdgeMeasures, 0.55},
                                   {Stage::kWrite, 0.01}};
constexpr StageShare kKineticHorizon[] = {
    {Stage::kRead, 0.01},         {Stage::kSweep, 0.01},  {Stage::kCandidates, 0.02},
    {Stage::kKineticSweep, 0.35}, {Stage::kDecide, 0.14}, {Stage::kLinesOfSight, 0.14},
    {Stage::kEdgeMeasures, 0.32}, {Stage::kWrite, 0.01}};
constexpr StageShare kSkyline[] = {{Stage::kRead, 0.02},         {Stage::kSweep, 0.08},
                                   {Stage::kCandidates, 0.07},   {Stage::kDecide, 0.15},
                                   {Stage::kLinesOfSight, 0.65}, {Stage::kWrite, 0.03}};
constexpr StageShare kVerify[] = {{Stage::kRead, 0.01},         {Stage::kSweep, 0.01},
                                  {Stage::kCandidates, 0.01},   {Stage::kDecide, 0.04},
                                  {Stage::kVerify, 0.23},       {Stage::kLinesOfSight, 0.09},
                                  {Stage::kEdgeMeasures, 0.18}, {Stage::kMeasure, 0.43}};
constexpr StageShare kTrace[] = {{Stage::kRead, 0.03},
                                 {Stage::kKineticSweep, 0.88},
                                 {Stage::kSweep, 0.02},
                                 {Stage::kCandidates, 0.06},
                                 {Stage::kWrite, 0.01}};
constexpr StageShare kCompare[] = {{Stage::kRead, 0.1},
                                   {Stage::kSweep, 0.1},
                                   {Stage::kCandidates, 0.1},
                                   {Stage::kDecide, 0.2},
                                   {Stage::kMeasure, 0.5}};

}  // namespace

std::span<const StageShare> PlanOf(Workflow workflow) {
  switch (workflow) {
    case Workflow::kBuild:
      return kBuild;
    case Workflow::kHorizon:
      return kHorizon;
    case Workflow::kKineticHorizon:
      return kKineticHorizon;
    case Workflow::kSkyline:
      return kSkyline;
    case Workflow::kVerify:
      return kVerify;
    case Workflow::kTrace:
      return kTrace;
    case Workflow::kCompare:
      return kCompare;
  }
  return kBuild;
}

int OverallProgress::Percent(Stage stage, double done) {
  double& so_far = done_[static_cast<std::size_t>(stage)];
  so_far = std::max(so_far, std::min(done, 1.0));
  double sum = 0;
  for (const StageShare& s : plan_) sum += s.share * done_[static_cast<std::size_t>(s.stage)];
  return std::min(static_cast<int>(100 * sum), 99);
}

}  // namespace farhorizon

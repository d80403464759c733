#include "core/pipeline/progress_plan.h"

#include <algorithm>
#include <cstddef>

namespace farhorizon {
namespace {

// TABLE
const std::vector<StageShare> kBuild = {{Stage::kRead, 0.02},         {Stage::kSweep, 0.01},
                                        {Stage::kCandidates, 0.01},   {Stage::kDecide, 0.04},
                                        {Stage::kSimplify, 0.43},     {Stage::kEncode, 0.04},
                                        {Stage::kMeasure, 0.29},      {Stage::kLinesOfSight, 0.05},
                                        {Stage::kEdgeMeasures, 0.10}, {Stage::kWrite, 0.01}};
const std::vector<StageShare> kHorizon = {
    {Stage::kRead, 0.02},   {Stage::kSweep, 0.02},        {Stage::kCandidates, 0.02},
    {Stage::kDecide, 0.25}, {Stage::kLinesOfSight, 0.22}, {Stage::kEdgeMeasures, 0.45},
    {Stage::kWrite, 0.02}};
const std::vector<StageShare> kKineticHorizon = {
    {Stage::kRead, 0.02},         {Stage::kSweep, 0.02},  {Stage::kCandidates, 0.02},
    {Stage::kKineticSweep, 0.40}, {Stage::kDecide, 0.10}, {Stage::kLinesOfSight, 0.15},
    {Stage::kEdgeMeasures, 0.27}, {Stage::kWrite, 0.02}};
const std::vector<StageShare> kSkyline = {{Stage::kRead, 0.04},         {Stage::kSweep, 0.04},
                                          {Stage::kCandidates, 0.04},   {Stage::kDecide, 0.40},
                                          {Stage::kLinesOfSight, 0.44}, {Stage::kWrite, 0.04}};
const std::vector<StageShare> kVerify = {{Stage::kRead, 0.01},         {Stage::kSweep, 0.01},
                                         {Stage::kCandidates, 0.01},   {Stage::kDecide, 0.10},
                                         {Stage::kVerify, 0.10},       {Stage::kLinesOfSight, 0.08},
                                         {Stage::kEdgeMeasures, 0.20}, {Stage::kMeasure, 0.49}};
const std::vector<StageShare> kTrace = {{Stage::kRead, 0.05},
                                        {Stage::kKineticSweep, 0.80},
                                        {Stage::kSweep, 0.05},
                                        {Stage::kCandidates, 0.05},
                                        {Stage::kWrite, 0.05}};

}  // namespace

const std::vector<StageShare>& PlanOf(Workflow workflow) {
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

// The plans by themselves, and held against what real runs report.
#include "core/pipeline/progress_plan.h"

#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/horizon/find_horizon.h"
#include "core/pipeline/build.h"
#include "core/pipeline/sweep_picture.h"
#include "core/pipeline/verify/verify.h"
#include "core/pipeline/write_horizon.h"
#include "core/pipeline/write_skyline.h"
#include "tests/support/hilly_grid.h"
#include "tests/support/progress_checks.h"
#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

using testing::IsEmpty;

TEST(PlanOf, HasEachStageOnceAndSharesThatMakeOne) {
  for (const Workflow workflow : kWorkflows) {
    std::set<Stage> stages;
    double sum = 0;
    for (const StageShare& s : PlanOf(workflow)) {
      EXPECT_GT(s.share, 0) << StageName(s.stage);
      EXPECT_TRUE(stages.insert(s.stage).second) << StageName(s.stage);
      sum += s.share;
    }
    EXPECT_NEAR(sum, 1, 1e-12) << static_cast<int>(workflow);
    EXPECT_EQ(PlanOf(workflow).front().stage, Stage::kRead);
  }
}

TEST(PlanOf, EveryStageIsInSomePlan) {
  std::set<Stage> stages;
  for (const Workflow workflow : kWorkflows) {
    for (const StageShare& s : PlanOf(workflow)) stages.insert(s.stage);
  }
  EXPECT_EQ(stages, std::set<Stage>(kStages.begin(), kStages.end()));
}

TEST(OverallProgress, AddsTheSharesOfWhatIsDone) {
  for (const Workflow workflow : kWorkflows) {
    OverallProgress overall(workflow);
    double before = 0;
    for (const StageShare& s : PlanOf(workflow)) {
      EXPECT_NEAR(overall.Percent(s.stage, 0), 100 * before, 1);
      EXPECT_NEAR(overall.Percent(s.stage, 0.5), 100 * (before + s.share / 2), 1);
      EXPECT_NEAR(overall.Percent(s.stage, 1), 100 * (before + s.share), 1);
      before += s.share;
    }
    EXPECT_EQ(overall.Percent(Stage::kRead, 1), 99) << "100 is for the caller to say";
  }
}

TEST(OverallProgress, NeverFallsWhateverIsReported) {
  OverallProgress overall(Workflow::kHorizon);
  const int at = overall.Percent(Stage::kEdgeMeasures, 0.9);
  EXPECT_GT(at, 10);
  EXPECT_EQ(overall.Percent(Stage::kEdgeMeasures, 0.1), at);
  EXPECT_EQ(overall.Percent(Stage::kEdgeMeasures, -5), at);
  EXPECT_EQ(overall.Percent(Stage::kSimplify, 1), at) << "no stage of this run";
  EXPECT_LE(overall.Percent(Stage::kEdgeMeasures, 1e9), 99);
}

// Real runs on a small DEM with a lake of no data.
class RealRuns : public testing::Test {
 protected:
  void SetUp() override {
    SpillFile(dem_, HillyGrid(40, 30));
    options_.crs = "EPSG:4326";
    options_.levels = 3;
  }
  [[nodiscard]] RunControl Recording() {
    reports_.clear();
    return {RecordInto(reports_), {}, {}};
  }

  TempDir folder_;
  std::filesystem::path dem_ = folder_ / "hills.asc";
  BuildOptions options_;
  std::vector<ProgressReport> reports_;
};

TEST_F(RealRuns, ABuildRises) {
  for (const int threads : {1, 3}) {
    options_.threads = threads;
    Status built = BuildArtifacts(dem_, folder_ / "out", options_, Recording());
    ASSERT_TRUE(built) << built.error().message;
    EXPECT_THAT(OffencesAgainstPlan(Workflow::kBuild, reports_), IsEmpty()) << threads;
  }
}

TEST_F(RealRuns, ABuildOfOtherFormatsAndLevelsRises) {
  options_.levels = 1;
  options_.formats = {"flatgeobuf"};
  Status built = BuildArtifacts(dem_, folder_ / "out", options_, Recording());
  ASSERT_TRUE(built) << built.error().message;
  EXPECT_THAT(OffencesAgainstPlan(Workflow::kBuild, reports_), IsEmpty());
}

TEST_F(RealRuns, TheHorizonByEitherEngineRises) {
  for (const auto& [engine, workflow] : {std::pair(Engine::kAdaptive, Workflow::kHorizon),
                                         std::pair(Engine::kKinetic, Workflow::kKineticHorizon)}) {
    for (const char* file : {"edges.geojson", "edges.fgb"}) {
      Status written = WriteHorizonEdges(dem_, folder_ / file,
                                         {.build = options_, .engine = engine}, Recording());
      ASSERT_TRUE(written) << written.error().message;
      EXPECT_THAT(OffencesAgainstPlan(workflow, reports_), IsEmpty()) << file;
    }
  }
}

TEST_F(RealRuns, AnApproximateHorizonRisesWhetherOrNotTheBudgetSuffices) {
  options_.approximate = true;
  for (const std::int64_t budget : {3'000, 10'000'000}) {
    options_.work_budget = budget;
    Status written =
        WriteHorizonEdges(dem_, folder_ / "edges.geojson", {.build = options_}, Recording());
    ASSERT_TRUE(written) << written.error().message;
    EXPECT_THAT(OffencesAgainstPlan(Workflow::kHorizon, reports_), IsEmpty()) << budget;
  }
}

TEST_F(RealRuns, ASkylineRises) {
  for (const SkylineFormat format : {SkylineFormat::kGeoJson, SkylineFormat::kSvg}) {
    Result<std::string> skyline = WriteSkyline(dem_, 33, format, options_, Recording());
    ASSERT_TRUE(skyline) << skyline.error().message;
    EXPECT_THAT(OffencesAgainstPlan(Workflow::kSkyline, reports_), IsEmpty());
  }
}

TEST_F(RealRuns, ATraceRises) {
  Status drawn = WriteSweepPicture(dem_, folder_ / "trace.svg", 500, options_, Recording());
  ASSERT_TRUE(drawn) << drawn.error().message;
  EXPECT_THAT(OffencesAgainstPlan(Workflow::kTrace, reports_), IsEmpty());
}

TEST_F(RealRuns, AVerificationRisesWithTheEdgesFileAndWithout) {
  for (const char* format : {"geojson", "drc"}) {
    options_.formats = {"3dtiles", format};
    Status built = BuildArtifacts(dem_, folder_ / format, options_, {});
    ASSERT_TRUE(built) << built.error().message;
    Result<std::vector<ClaimCheck>> checks =
        VerifyArtifacts(dem_, folder_ / format, options_, Recording());
    ASSERT_TRUE(checks) << checks.error().message;
    std::vector<std::string> offences = OffencesAgainstPlan(Workflow::kVerify, reports_);
    EXPECT_THAT(offences, IsEmpty()) << format;
  }
}

TEST(OffencesAgainstPlan, SeesEveryOffence) {
  std::vector<ProgressReport> reports;
  for (const StageShare& s : PlanOf(Workflow::kSkyline)) {
    reports.push_back({s.stage, 0});
    reports.push_back({s.stage, 1});
  }
  EXPECT_THAT(OffencesAgainstPlan(Workflow::kSkyline, reports), IsEmpty());
  EXPECT_THAT(OffencesAgainstPlan(Workflow::kSkyline, {}), testing::Not(IsEmpty()));
  const auto with = [&reports](std::size_t i, ProgressReport report) {
    std::vector<ProgressReport> changed = reports;
    changed.insert(changed.begin() + static_cast<std::ptrdiff_t>(i), report);
    return OffencesAgainstPlan(Workflow::kSkyline, changed);
  };
  EXPECT_THAT(with(4, {Stage::kSweep, 0.5}), testing::Contains(testing::HasSubstr("falls")));
  EXPECT_THAT(with(4, {Stage::kSweep, 0.5}),
              testing::Contains(testing::HasSubstr("makes the whole fall")));
  EXPECT_THAT(with(4, {Stage::kSimplify, 0}), testing::Contains(testing::HasSubstr("planned")));
  EXPECT_THAT(with(4, {Stage::kWrite, 0}), testing::Contains(testing::HasSubstr("planned")));
  EXPECT_THAT(with(0, {Stage::kRead, 1}), testing::Contains(testing::HasSubstr("falls")));
  EXPECT_THAT(with(reports.size(), {Stage::kWrite, 1.5}),
              testing::Contains(testing::HasSubstr("no share")));
  reports.pop_back();
  EXPECT_THAT(OffencesAgainstPlan(Workflow::kSkyline, reports),
              testing::Contains(testing::HasSubstr("ends before 1")));
}

}  // namespace
}  // namespace farhorizon

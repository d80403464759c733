// What the program says of its progress: `--progress json`, and a worker on its descriptor 3.
#include <algorithm>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/hilly_grid.h"
#include "tests/support/progress_checks.h"
#include "tests/support/service_process.h"
#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

using nlohmann::json;
using testing::IsEmpty;

// The reports among the lines of a file; the numbers of their "progress" go to `percents`.
std::vector<ProgressReport> ReportsIn(const std::string& text, std::vector<int>& percents) {
  std::vector<ProgressReport> reports;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const json object = json::parse(line, nullptr, false);
    if (!object.is_object() || !object.contains("stage")) continue;
    const std::optional<Stage> stage = StageFromName(object["stage"].get<std::string>());
    EXPECT_TRUE(stage) << line;
    if (stage) reports.push_back({*stage, object["done"]});
    percents.push_back(object.value("progress", 0));
  }
  return reports;
}

class ProgressE2e : public testing::Test {
 protected:
  void SetUp() override { SpillFile(folder_ / "hills.asc", HillyGrid(40, 30)); }

  // Runs `farhorizon WORDS… --crs EPSG:4326 --progress json` and holds what it says to the plan.
  void ExpectRise(Workflow workflow, std::vector<std::string> words) {
    words.insert(words.begin(), FARHORIZON_PROGRAM);
    words.insert(words.end(), {"--crs", "EPSG:4326", "--progress", "json", "--threads", "2"});
    std::filesystem::remove(folder_ / "stderr");
    ASSERT_EQ(Process(words, {}, folder_ / "stderr").Wait(std::chrono::seconds(300)), 0)
        << SlurpFile(folder_ / "stderr");
    std::vector<int> percents;
    const std::vector<ProgressReport> reports = ReportsIn(SlurpFile(folder_ / "stderr"), percents);
    EXPECT_THAT(OffencesAgainstPlan(workflow, reports), IsEmpty()) << words[1];
    ASSERT_FALSE(percents.empty());
    EXPECT_TRUE(std::is_sorted(percents.begin(), percents.end()))
        << words[1] << testing::PrintToString(percents);
    EXPECT_LE(percents.front(), 2);
    EXPECT_GE(percents.back(), 95);
  }
  [[nodiscard]] std::string At(const std::string& name) const { return (folder_ / name).string(); }

  TempDir folder_;
};

TEST_F(ProgressE2e, RisesAndNeverFallsInEveryCommand) {
  const std::string dem = At("hills.asc");
  ExpectRise(Workflow::kBuild, {"build", dem, "-o", At("out")});
  ExpectRise(Workflow::kVerify, {"verify", dem, At("out")});
  ExpectRise(Workflow::kHorizon, {"horizon", dem, "-o", At("edges.geojson")});
  ExpectRise(Workflow::kKineticHorizon,
             {"horizon", dem, "-o", At("edges.fgb"), "--engine", "kinetic"});
  ExpectRise(Workflow::kTrace, {"horizon", dem, "-o", At("trace.svg"), "--trace-level", "500"});
  ExpectRise(Workflow::kSkyline, {"skyline", dem, "-o", At("skyline.svg"), "--azimuth", "33"});
}

TEST_F(ProgressE2e, RisesAndNeverFallsInAJob) {
  SpillFile(folder_ / "task.json", json{{"input", "hills.asc"},
                                        {"output", "out"},
                                        {"parameters", {{"crs", "EPSG:4326"}}},
                                        {"maxPosts", 1'000'000},
                                        {"threads", 2},
                                        {"echo", false}}
                                       .dump());
  const std::string script =
      "cd '" + folder_.path().string() + "' && exec '" FARHORIZON_PROGRAM "' worker 3>messages";
  ASSERT_EQ(
      Process({"/bin/sh", "-c", script}, {}, folder_ / "stderr").Wait(std::chrono::seconds(300)), 0)
      << SlurpFile(folder_ / "stderr");
  std::vector<int> percents;
  const std::vector<ProgressReport> reports = ReportsIn(SlurpFile(folder_ / "messages"), percents);
  EXPECT_THAT(OffencesAgainstPlan(Workflow::kBuild, reports), IsEmpty());
}

}  // namespace
}  // namespace farhorizon

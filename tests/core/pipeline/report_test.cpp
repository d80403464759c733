#include "core/pipeline/report.h"

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

Report SomeReport() {
  Report report;
  report.version = "1.2.3";
  report.dem = {403, 344, "EPSG:4326", {25.1, 30.9}, {236, 1076}, 7, 0.5, true, "abc"};
  report.horizon_edges = 6500;
  report.statistics.terrain_edges = 413000;
  report.statistics.candidates = 60000;
  report.statistics.peaks = 12;
  report.statistics.predicates = {1, 2, 3};
  report.statistics.undecided = 9;
  report.statistics.work_budget = 1'000'000'000'000;
  report.levels.push_back(
      {0, 10, 11, 12, 2.5, 0.5, {1.5, 0.5}, {0.25, 0.125}, 3.5, 0.0625, 1000, 900});
  return report;
}

TEST(Report, ReadsBackWhatItWrote) {
  const std::string text = WriteReport(SomeReport());
  Result<Report> read = ReadReport(text);
  ASSERT_TRUE(read);
  EXPECT_EQ(WriteReport(*read), text);
  EXPECT_EQ(read->levels.front().silhouette.max_m, 0.25);
  EXPECT_EQ(read->dem.heights_rounded, true);
  EXPECT_EQ(read->statistics.undecided, 9);
  EXPECT_EQ(read->statistics.work_budget, 1'000'000'000'000);
  EXPECT_NE(text.find(R"("approximate": true)"), std::string::npos) << text;
}

TEST(Report, NamesTheMemberThatIsMissing) {
  Result<Report> read = ReadReport(R"({"farhorizon": "1"})");
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().kind, "bad-report");
  EXPECT_NE(read.error().message.find("dem"), std::string::npos) << read.error().message;
}

TEST(RoundUp, NeverLowersABound) {
  for (const double value : {0.0, 1e-9, 0.1, 1.0 / 3, 12.3456789, 5000.0}) {
    EXPECT_GE(RoundUp(value), value);
    EXPECT_LE(RoundUp(value), value + 1.1e-6);
  }
}

}  // namespace
}  // namespace farhorizon

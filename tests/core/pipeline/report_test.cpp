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
  LevelReport finest;
  finest.exact = true;
  finest.triangles = 10;
  finest.vertices = 11;
  finest.horizon_edges = 12;
  finest.asked = {.vertical_m = 2.5, .silhouette_m = 0.5};
  finest.vertical = {1.5, 0.5};
  finest.silhouette = {0.25, 0.125};
  finest.rim_m = 0.75;
  finest.facet_angle_deg = 7.5;
  finest.needle_share = 0.005;
  finest.geometric_error_m = 3.5;
  finest.quantization_step_m = 0.0625;
  finest.glb_bytes = 1000;
  finest.drc_bytes = 900;
  finest.skyline_edges = {13, 12, 0.9985, 4000};
  LevelReport coarser = finest;
  coarser.level = 1;
  coarser.exact = false;
  coarser.asked = {.triangles = 4};
  report.levels = {finest, coarser};
  return report;
}

TEST(Report, ReadsBackWhatItWrote) {
  const std::string text = WriteReport(SomeReport());
  Result<Report> read = ReadReport(text);
  ASSERT_TRUE(read);
  EXPECT_EQ(WriteReport(*read), text);
  EXPECT_EQ(read->levels.front().silhouette.max_m, 0.25);
  EXPECT_EQ(read->levels.front().rim_m, 0.75);
  EXPECT_EQ(read->levels.front().facet_angle_deg, 7.5);
  EXPECT_EQ(read->levels.front().needle_share, 0.005);
  EXPECT_TRUE(read->levels[0].exact);
  EXPECT_EQ(read->levels[0].asked.triangles, 0);
  EXPECT_EQ(read->levels[0].asked.vertical_m, 2.5);
  EXPECT_FALSE(read->levels[1].exact);
  EXPECT_EQ(read->levels[1].asked.triangles, 4);
  EXPECT_EQ(read->levels[0].skyline_edges.carrying, 12);
  EXPECT_EQ(read->levels[0].skyline_edges.share, 0.9985);
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

// The page's charts, and the tables beside them.
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/pipeline/report_page/account.h"
#include "core/pipeline/report_page/claims.h"
#include "core/pipeline/report_page/error_chart.h"
#include "core/pipeline/report_page/level_table.h"
#include "core/pipeline/report_page/skyline_chart.h"
#include "tests/support/html_checks.h"
#include "tests/support/metre_steps.h"
#include "tests/support/terrains.h"

namespace farhorizon {
namespace {

using testing::IsEmpty;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// Lines over ground that rises from 100 to 200 metres, and levels that are off by so much.
SkylineSet Sloping(const std::vector<double>& off) {
  const Dem dem = MakeDem(50, 50, [](auto, auto) { return 0; });
  SkylineSet set{LinesAcross(dem, kMetreSteps, 0, kLinesAcross), {}, {}};
  for (int i = 0; i < kLinesAcross; ++i) set.terrain.push_back(100 + 100.0 * i / kLinesAcross);
  for (const double d : off) {
    set.levels.push_back(set.terrain);
    set.levels.back()[500] += d;
  }
  return set;
}

// A matcher would print all of it.
bool Has(const Html& html, std::string_view text) {
  return html.markup().find(text) != std::string::npos;
}

void ExpectSound(const Html& html) {
  EXPECT_THAT(HtmlOffences::Of(html.markup()), IsEmpty());
  EXPECT_FALSE(Has(html, "nan"));
  EXPECT_FALSE(Has(html, "inf"));
}

TEST(DifferenceOf, LeavesOutLinesThatOneOfThemMisses) {
  const SkylineDifference off = DifferenceOf({1, 2, kNone, 4}, {1, 5, 7, kNone});
  EXPECT_EQ(off.greatest_m, 3);
  EXPECT_DOUBLE_EQ(off.rms_m, std::sqrt(9 / 2.0));
  EXPECT_EQ(DifferenceOf({kNone}, {1}).greatest_m, 0);
}

TEST(ScaleOf, EnlargesDifferencesByARoundFactorThatFits) {
  const SkylineScale scale = ScaleOf({Sloping({0.5, 7})});
  // 110 pixels for 110 metres, 38 pixels to either side.
  EXPECT_NEAR(scale.pixels_a_metre, 1, 0.01);
  EXPECT_EQ(scale.level_factors[0], 50);
  EXPECT_EQ(scale.level_factors[1], 5);
  EXPECT_EQ(scale.common_factor, 5);
}

TEST(SkylineChart, SaysByHowMuchDifferencesAreEnlarged) {
  const SkylineSet set = Sloping({0.5, 7});
  const Html chart = SkylineChart(set, ScaleOf({set}));
  ExpectSound(chart);
  EXPECT_TRUE(Has(chart, "data-level=\"0\" x=\"46\""));
  EXPECT_TRUE(Has(chart, "enlarged 50 times"));
  EXPECT_TRUE(Has(chart, "enlarged 5 times"));
  // One column of the chart is where level 1 is off: 7 m * 5 pixels up, and back.
  EXPECT_TRUE(Has(chart, " 1 0 1 -350 1 350 1 0"));
  EXPECT_TRUE(Has(MirroredSkylineChart(set, ScaleOf({set})), "looking south"));
}

TEST(SkylineChart, TakesLevelGroundAndLinesOverNothing) {
  SkylineSet set = Sloping({0});
  set.terrain.assign(set.terrain.size(), 12);
  set.levels.front() = set.terrain;
  ExpectSound(SkylineChart(set, ScaleOf({set})));
  for (std::size_t i = 300; i < 600; ++i) set.terrain[i] = set.levels.front()[i] = kNone;
  ExpectSound(SkylineChart(set, ScaleOf({set})));
  set.terrain.assign(set.terrain.size(), kNone);
  set.levels.front() = set.terrain;
  ExpectSound(SkylineChart(set, ScaleOf({set})));
}

LevelReport SomeLevel(int level, std::int64_t triangles, double error) {
  LevelReport report;
  report.level = level;
  report.triangles = triangles;
  report.vertices = triangles / 2;
  report.vertical = {error, error / 3};
  report.silhouette = {error / 5, error / 50};
  return report;
}

TEST(ErrorChart, HasAPointForEachErrorOfEachLevel) {
  const Html chart = ErrorChart({SomeLevel(0, 50000, 1), SomeLevel(1, 20000, 3)});
  ExpectSound(chart);
  std::size_t points = 0;
  for (std::size_t at = 0; (at = chart.markup().find("<title>", at)) != std::string::npos; ++at) {
    ++points;
  }
  EXPECT_EQ(points, 8U);
  EXPECT_TRUE(Has(chart, "level 1: 3.00 m at 20,000 triangles"));
}

TEST(ErrorChart, TakesOneLevelWithoutErrors) {
  ExpectSound(ErrorChart({SomeLevel(0, 2, 0)}));
  ExpectSound(ErrorChart({SomeLevel(0, 1, 5), SomeLevel(1, 1, 0)}));
}

Report SomeReport() {
  Report report;
  report.dem.crs = "</dd><script>alert(1)</script>";
  report.dem.heights_m = {-3.25, 8848};
  report.dem.nodata_posts = 7;
  report.dem.sha256 = "abc";
  report.horizon_edges = 10;
  report.statistics.terrain_edges = 1000;
  report.levels = {SomeLevel(0, 100, 1)};
  report.levels.front().horizon_edges = 10;
  report.levels.front().exact = true;
  report.assumptions = {{"height-unit", "taken for <b>feet</b> & \"inches\""}};
  return report;
}

TEST(Tables, EscapeWhatComesFromTheFile) {
  const Report report = SomeReport();
  for (const Html& html : {FactsOf(report.dem), AssumptionList(report.assumptions),
                           ClaimList(report, true), LevelTable(report, 400)}) {
    ExpectSound(html);
    EXPECT_FALSE(Has(html, "<script"));
    EXPECT_FALSE(Has(html, "<b>"));
  }
  EXPECT_TRUE(Has(FactsOf(report.dem), "&lt;script&gt;"));
  EXPECT_TRUE(Has(AssumptionList({}), "Nothing"));
}

TEST(ClaimList, SaysWhatDoesNotHold) {
  Report report = SomeReport();
  EXPECT_TRUE(Has(ClaimList(report, true), "Every horizon edge is found"));
  EXPECT_TRUE(Has(ClaimList(report, true), "Level 0 is exact"));
  EXPECT_FALSE(Has(ClaimList(report, false), "witness"));
  report.statistics.undecided = 1;
  report.levels.front().horizon_edges = 4;
  report.levels.front().exact = false;
  EXPECT_TRUE(Has(ClaimList(report, true), "1 edge was decided"));
  EXPECT_TRUE(Has(ClaimList(report, true), "4 of 10 horizon edges"));
  EXPECT_TRUE(Has(ClaimList(report, true), "No level is exact"));
}

TEST(BytesTable, SaysBytesForEachTriangleAndEdge) {
  const Html table =
      BytesTable(SomeReport(),
                 {{"lod0.glb", "", 250, ""}, {"horizon.geojson", "", 5000, ""}, {"x", "", 1, ""}});
  ExpectSound(table);
  EXPECT_TRUE(Has(table, "2.50 a triangle"));
  EXPECT_TRUE(Has(table, "500 a horizon edge"));
  EXPECT_LT(table.markup().find("horizon.geojson"), table.markup().find("lod0.glb"));
}

TEST(TimesTable, HasStagesInTheirOrderOrNone) {
  EXPECT_TRUE(Has(TimesTable({}), "--timings"));
  const Html table = TimesTable({{"encode", 1}, {"read", 3}});
  ExpectSound(table);
  EXPECT_LT(table.markup().find("read"), table.markup().find("encode"));
  EXPECT_TRUE(Has(table, "75.0 %"));
}

}  // namespace
}  // namespace farhorizon

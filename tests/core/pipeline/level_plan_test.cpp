#include "core/pipeline/level_plan.h"

#include <functional>
#include <memory>

#include <gtest/gtest.h>

#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

constexpr double kEarthRadiusM = 6371000;

// A grid in UTM of 20 x 16 posts.
struct Planned {
  Planned(double cell_m, const std::function<double(int, int)>& height, BuildOptions options = {}) {
    std::string text = "ncols 20\nnrows 16\nxllcorner 500000\nyllcorner 5100000\ncellsize " +
                       std::to_string(cell_m) + "\n";
    for (int r = 0; r < 16; ++r) {
      for (int c = 0; c < 20; ++c) text += std::to_string(height(c, r)) + (c < 19 ? " " : "\n");
    }
    SpillFile(folder / "dem.asc", text);
    options.crs = "EPSG:32610";
    input = *TerrainInput::Open(folder / "dem.asc", options, {});
    Result<LevelPlan> planned = PlanLevels(*input, options);
    if (planned) {
      plan = *std::move(planned);
    } else {
      kind = planned.error().kind;
      message = planned.error().message;
    }
  }
  TempDir folder;
  std::unique_ptr<TerrainInput> input;
  LevelPlan plan;
  std::string kind;
  std::string message;
};

double Saddle(int c, int r) { return 500 + c * 10 - r * 5; }

TEST(PlanLevels, TheDefaultErrorFollowsTheCell) {
  const Planned some(30, [](int c, int r) { return 10 * Saddle(c, r); });  // relief 2650 m
  EXPECT_NEAR(some.plan.max_error_m, 30.0 / 8, 0.01);
  EXPECT_LT(some.plan.lods.max_error_m, some.plan.max_error_m);
  EXPECT_GE(some.plan.lods.max_error_m, some.plan.max_error_m / 2);
}

TEST(PlanLevels, TheDefaultErrorFollowsTheReliefToo) {
  const Planned some(1000, Saddle);  // relief 19 * 10 + 15 * 5
  EXPECT_NEAR(some.plan.max_error_m, 265.0 / 64, 1e-9);
}

TEST(PlanLevels, TheDefaultErrorIsNoLessThanWhatHeightsAndRoundingTell) {
  const Planned quanta(30, [](int c, int r) { return (c * r) % 3; });  // whole metres, relief 2
  EXPECT_EQ(quanta.plan.max_error_m, 1);
  // Level ground: half a step up or down, and as much kept for the simplifier.
  const Planned flat(30, [](int, int) { return 7.5; });
  EXPECT_GE(flat.plan.max_error_m, 0.125);
  EXPECT_LE(flat.plan.max_error_m, 1);
}

TEST(PlanLevels, AnErrorThatIsAskedForIsTakenOrRefused) {
  BuildOptions options;
  options.levels = 3;
  options.max_error_m = 0.25;
  options.silhouette_error_m = 2;
  const Planned taken(30, Saddle, options);
  EXPECT_EQ(taken.plan.max_error_m, 0.25);
  EXPECT_EQ(taken.plan.lods.levels, 3);
  EXPECT_EQ(taken.plan.lods.silhouette_error_m, 2);
  EXPECT_TRUE(taken.plan.lods.triangles.empty());
  options.max_error_m = 1e-5;
  const Planned refused(30, Saddle, options);
  EXPECT_EQ(refused.kind, "max-error-too-small");
  EXPECT_NE(refused.message.find("ask for "), std::string::npos) << refused.message;
}

TEST(PlanLevels, WhatTheRefusalOffersIsTaken) {
  BuildOptions options;
  options.max_error_m = 1e-5;
  const Planned refused(30, Saddle, options);
  const std::size_t at = refused.message.find("ask for ") + 8;
  options.max_error_m = std::stod(refused.message.substr(at));
  EXPECT_EQ(Planned(30, Saddle, options).kind, "");
}

TEST(PlanLevels, TrianglesGoToTheSimplifierAsTheyAre) {
  BuildOptions options;
  options.triangles = {200, 50, 2};
  const Planned some(30, Saddle, options);
  EXPECT_EQ(some.plan.lods.triangles, options.triangles);
  EXPECT_EQ(some.plan.max_error_m, 0);
}

TEST(PlanLevels, TheEarthDropsBySquaresOfTheStep) {
  const Planned some(1000, Saddle);
  EXPECT_NEAR(some.plan.lods.column_bend, 1e6 / (2 * kEarthRadiusM), 1e-3);
  EXPECT_NEAR(some.plan.lods.row_bend, 1e6 / (2 * kEarthRadiusM), 1e-3);
}

TEST(CoarsenessOf, IsTheLevelsNumberBySizeAndOfItsShareByTriangles) {
  Dem dem;
  dem.columns = 101;
  dem.rows = 51;  // 10,000 triangles in all
  LevelPlan plan;
  EXPECT_EQ(CoarsenessOf(plan, dem, 0), 0);
  EXPECT_EQ(CoarsenessOf(plan, dem, 4), 4);
  plan.lods.triangles = {20000, 2000, 1601, 1600, 640, 100};
  EXPECT_EQ(CoarsenessOf(plan, dem, 0), 0);
  EXPECT_EQ(CoarsenessOf(plan, dem, 1), 0);
  EXPECT_EQ(CoarsenessOf(plan, dem, 2), 0);
  EXPECT_EQ(CoarsenessOf(plan, dem, 3), 1);
  EXPECT_EQ(CoarsenessOf(plan, dem, 4), 2);
  EXPECT_EQ(CoarsenessOf(plan, dem, 5), 4);
}

}  // namespace
}  // namespace farhorizon

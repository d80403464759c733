#include "core/pipeline/compare/mesh_over_posts.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/pipeline/compare/covered_part.h"
#include "core/pipeline/compare/terrain_height.h"

namespace farhorizon {
namespace {

Dem Level(std::int32_t columns, std::int32_t rows) {
  Dem dem;
  dem.columns = columns;
  dem.rows = rows;
  dem.heights.assign(static_cast<std::size_t>(columns * rows), 0);
  return dem;
}

// Two triangles over a rectangle, counter-clockwise on the map.
GridMesh Sheet(double c0, double r0, double c1, double r1, double height = 5) {
  return {{{c0, r0, height}, {c1, r0, height}, {c0, r1, height}, {c1, r1, height}},
          {{0, 2, 3}, {0, 3, 1}}};
}

std::vector<double> HeightsOver(const GridMesh& mesh, const Dem& dem) {
  return *HeightsOverPosts(mesh, dem);
}

std::int64_t Covered(const std::vector<double>& heights) {
  return std::ranges::count_if(heights, [](double h) { return !std::isnan(h); });
}

TEST(HeightsOverPosts, IsThePlaneOfTheTriangleAtEachPost) {
  const Dem dem = Level(9, 7);
  // 3 column - 2 row + 11 over a triangle between posts.
  GridMesh mesh{{{0.5, 0.5, 11.5}, {0.5, 5.5, 1.5}, {7.5, 5.5, 22.5}}, {{0, 1, 2}}};
  const std::vector<double> heights = HeightsOver(mesh, dem);
  int inside = 0;
  for (int r = 0; r < dem.rows; ++r) {
    for (int c = 0; c < dem.columns; ++c) {
      const double h = heights[static_cast<std::size_t>(r * dem.columns + c)];
      const bool within = c >= 1 && r <= 5 && (r - 0.5) * 7 >= (c - 0.5) * 5;
      EXPECT_EQ(!std::isnan(h), within) << c << " " << r;
      inside += within ? 1 : 0;
      if (within) {
        EXPECT_NEAR(h, 3 * c - 2 * r + 11, 1e-12);
      }
    }
  }
  EXPECT_GT(inside, 10);
}

TEST(HeightsOverPosts, CoversARimThatRoundingMoved) {
  const Dem dem = Level(5, 4);
  EXPECT_EQ(Covered(HeightsOver(Sheet(0.01, 0.02, 3.99, 2.98), dem)), 20);
  EXPECT_EQ(Covered(HeightsOver(Sheet(0.2, 0, 4, 3), dem)), 16);
  EXPECT_EQ(Covered(HeightsOver(Sheet(-100, -100, 100, 100), dem)), 20);
  EXPECT_EQ(Covered(HeightsOver(Sheet(10, 10, 20, 20), dem)), 0);
}

TEST(HeightsOverPosts, RefusesWorkWithoutBound) {
  const Dem dem = Level(50, 50);
  GridMesh mesh = Sheet(0, 0, 49, 49);
  for (int i = 0; i < 200; ++i) mesh.triangles.push_back({0, 2, 3});
  const auto heights = HeightsOverPosts(mesh, dem);
  ASSERT_FALSE(heights);
  EXPECT_EQ(heights.error().kind, "overlap");
}

TEST(TurnCounterClockwise, TurnsAllWhereMostOfTheAreaIsClockwise) {
  GridMesh mesh = Sheet(0, 0, 5, 5);
  EXPECT_FALSE(TurnCounterClockwise(mesh));
  const GridMesh before = mesh;
  for (auto& t : mesh.triangles) std::swap(t[0], t[1]);
  EXPECT_TRUE(TurnCounterClockwise(mesh));
  // One small triangle the other way stays so.
  mesh.points.push_back({1, 1, 0});
  mesh.points.push_back({2, 1, 0});
  mesh.points.push_back({1, 2, 0});
  mesh.triangles.push_back({4, 5, 6});
  EXPECT_FALSE(TurnCounterClockwise(mesh));
  EXPECT_EQ(before.triangles.size(), 2U);
}

TEST(DropSkirts, DropsWhatHangsAndKeepsWhatStands) {
  GridMesh mesh = Sheet(0, 0, 4, 4, 100);
  // A skirt below the side from point 0 to point 2, its foot out of plumb as rounding leaves it.
  mesh.points.push_back({0, 0, 70});
  mesh.points.push_back({1e-7, 4, 70});
  mesh.triangles.push_back({0, 4, 2});
  mesh.triangles.push_back({2, 4, 5});
  GridMesh fence = mesh;
  EXPECT_EQ(DropSkirts(mesh, 30), 2);
  EXPECT_EQ(mesh.triangles.size(), 2U);
  fence.points[4].height_m = 130;
  EXPECT_EQ(DropSkirts(fence, 30), 0) << "each of both has a corner above the ground";
}

TEST(DropSkirts, KeepsCliffs) {
  // 1 km over a metre.
  GridMesh mesh{{{0, 0, 0}, {1, 0, 1000}, {0, 1, 0}, {1, 1, 1000}}, {{0, 2, 3}, {0, 3, 1}}};
  EXPECT_EQ(DropSkirts(mesh, 1), 0);
}

TEST(PartUnder, IsTheCoveredBoxWithTheRestLeftOut) {
  Dem dem = Level(12, 10);
  dem.transform = {1000, 2000, 30, -30};
  for (std::size_t i = 0; i < dem.heights.size(); ++i) dem.heights[i] = static_cast<int>(i);
  EXPECT_EQ(PartUnder(HeightsOver(Sheet(0, 0, 11, 9), dem), dem), std::nullopt);
  EXPECT_EQ(PartUnder(HeightsOver(Sheet(0.3, 0.3, 10.7, 8.7), dem), dem), std::nullopt)
      << "a rim that has shrunk";
  GridMesh mesh = Sheet(3, 2, 8, 6);
  const auto part = PartUnder(HeightsOver(mesh, dem), dem);
  ASSERT_TRUE(part);
  EXPECT_EQ(part->dem.columns, 6);
  EXPECT_EQ(part->dem.rows, 5);
  EXPECT_EQ(part->dem.heights.front(), 2 * 12 + 3);
  EXPECT_EQ(part->dem.heights.back(), 6 * 12 + 8);
  EXPECT_EQ(part->dem.transform.origin_x, 1090);
  EXPECT_EQ(part->dem.transform.origin_y, 1940);
  MoveInto(*part, mesh);
  EXPECT_EQ(mesh.points.front().column, 0);
  EXPECT_EQ(mesh.points.front().row, 0);
  // A triangle leaves out half of its box.
  mesh = {{{2, 2, 0}, {2, 8, 0}, {8, 8, 0}}, {{0, 1, 2}}};
  const auto half = PartUnder(HeightsOver(mesh, dem), dem);
  ASSERT_TRUE(half);
  EXPECT_EQ(std::ranges::count(half->dem.heights, kNoHeight), 21);
}

TEST(PartUnder, HasTwoColumnsAndRowsAtLeast) {
  const Dem dem = Level(12, 10);
  for (const double at : {0.0, 5.0, 9.0}) {
    const auto part =
        PartUnder(HeightsOver(Sheet(at - 0.2, at - 0.2, at + 0.2, at + 0.2), dem), dem);
    ASSERT_TRUE(part);
    EXPECT_EQ(part->dem.columns, 2);
    EXPECT_EQ(part->dem.rows, 2);
    EXPECT_EQ(part->dem.heights.size(), 4U);
  }
}

TEST(CountHolePosts, CountsPostsWithinAndNoneBesideTheRimOrMissingGround) {
  Dem dem = Level(12, 10);
  std::vector<double> heights(dem.heights.size(), 0.0);
  EXPECT_EQ(CountHolePosts(heights, dem), 0);
  const auto bare = [&](std::int32_t c, std::int32_t r) -> double& {
    return heights[static_cast<std::size_t>(r * dem.columns + c)];
  };
  bare(5, 5) = bare(5, 6) = bare(9, 2) = std::nan("");
  EXPECT_EQ(CountHolePosts(heights, dem), 3);
  bare(0, 4) = bare(1, 4) = std::nan("");
  EXPECT_EQ(CountHolePosts(heights, dem), 3) << "open to the rim";
  dem.heights[static_cast<std::size_t>(2 * dem.columns + 9)] = kNoHeight;
  EXPECT_EQ(CountHolePosts(heights, dem), 2);
}

TEST(TerrainHeightAt, IsTheTriangleOfTheCell) {
  Dem dem = Level(3, 3);
  dem.heights = {0, 10, 0, 20, 40, 0, 0, 0, kNoHeight};
  EXPECT_EQ(TerrainHeightAt(dem, 1, 1), 40);
  EXPECT_EQ(TerrainHeightAt(dem, 0.5, 0.5), 20) << "on the diagonal";
  EXPECT_EQ(TerrainHeightAt(dem, 0.5, 0), 5);
  EXPECT_EQ(TerrainHeightAt(dem, 0, 0.5), 10);
  EXPECT_EQ(TerrainHeightAt(dem, 0.75, 0.25), 15.0);
  EXPECT_EQ(TerrainHeightAt(dem, 1.5, 1.5), std::nullopt);
  EXPECT_EQ(TerrainHeightAt(dem, 2.01, 0), std::nullopt);
  EXPECT_EQ(TerrainHeightAt(dem, std::nan(""), 0), std::nullopt);
}

}  // namespace
}  // namespace farhorizon

// The judge against what its figures are defined as.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "grid.h"
#include "skylines.h"
#include "surfaces.h"

namespace farhorizon::peers {

namespace {

constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();

Grid RandomGrid(std::int32_t columns, std::int32_t rows, unsigned seed) {
  std::mt19937 random(seed);
  Grid grid{columns, rows, {}};
  for (std::int32_t i = 0; i < columns * rows; ++i)
    grid.heights.push_back(static_cast<float>(random() % 1000) / 100);
  return grid;
}

/// The four corners of a grid, as high as its posts, and any inner point, in four triangles.
Mesh Tent(const Grid& grid, Point top) {
  const double right = grid.columns - 1, low = grid.rows - 1;
  const auto z = [&](std::int32_t c, std::int32_t r) {
    return double(grid.heights[grid.At(c, r)]);
  };
  const std::int32_t c = grid.columns - 1, r = grid.rows - 1;
  return {{{0, 0, z(0, 0)}, {right, 0, z(c, 0)}, {right, low, z(c, r)}, {0, low, z(0, r)}, top},
          {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}};
}

struct Over {
  bool there = false;
  double height = 0;
};

/// The height of a mesh over a point, by asking every triangle.
Over HeightOver(const Mesh& mesh, double x, double y) {
  Over over;
  for (const auto& t : mesh.triangles) {
    const Point &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    const double v = ((x - a.x) * (c.y - a.y) - (y - a.y) * (c.x - a.x)) / area;
    const double w = ((b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x)) / area;
    if (v < -1e-9 || w < -1e-9 || v + w > 1 + 1e-9) continue;
    const double height = a.z + v * (b.z - a.z) + w * (c.z - a.z);
    over = {true, over.there ? std::max(over.height, height) : height};
  }
  return over;
}

/// H by its definition: the highest of many points of the line that is `across` from the origin.
double HighestOver(const Mesh& mesh, double angle, double across) {
  double highest = -std::numeric_limits<double>::infinity();
  for (double along = -20; along <= 20; along += 1e-3) {
    const double x = std::cos(angle) * along - std::sin(angle) * across;
    const double y = std::sin(angle) * along + std::cos(angle) * across;
    const Over over = HeightOver(mesh, x, y);
    if (over.there) highest = std::max(highest, over.height);
  }
  return highest;
}

}  // namespace

TEST(Judge, TheFullMeshHasNoErrors) {
  const Grid grid = RandomGrid(9, 7, 1);
  const Mesh full = FullMesh(grid);
  const SilhouetteErrors silhouette = Skylines(grid, 96, 2).ErrorsOf(full);
  EXPECT_EQ(silhouette.rms, 0);
  EXPECT_EQ(silhouette.missed, 0);
  EXPECT_GT(silhouette.lines, 96 * 2 * 6);
  const VerticalErrors vertical = VerticalErrorsOf(full, grid);
  EXPECT_NEAR(vertical.max, 0, 1e-5);
  EXPECT_EQ(vertical.uncovered, 0);
  EXPECT_NEAR(FacetAngleRms(full, grid, {30, 40}), 0, 1e-6);
}

TEST(Judge, SilhouettesAreTheHighestPointsOverLines) {
  const Grid grid = RandomGrid(6, 5, 2);
  const Mesh full = FullMesh(grid), tent = Tent(grid, {2.3, 1.6, 9});
  double squares = 0, greatest = 0;
  int lines = 0;
  for (int k = 0; k < 4; ++k) {
    const double angle = std::fmod(k * 0.6180339887498949 + 0.1234567, 1.0) * std::numbers::pi;
    const double low = std::min(0., -std::sin(angle) * 5) + std::min(0., std::cos(angle) * 4);
    for (double across = low;; across += 0.5) {
      const double dem = HighestOver(full, angle, across), mesh = HighestOver(tent, angle, across);
      if (across > low && std::isinf(dem)) break;  // beyond the grid
      if (std::isinf(dem) || std::isinf(mesh)) continue;
      squares += (dem - mesh) * (dem - mesh);
      greatest = std::max(greatest, std::abs(dem - mesh));
      ++lines;
    }
  }
  const SilhouetteErrors errors = Skylines(grid, 4, 2).ErrorsOf(tent);
  EXPECT_GE(lines, 40);
  // A line that passes through a corner alone meets no sample; its error is 0.
  EXPECT_NEAR(static_cast<double>(errors.lines), lines, 4);
  EXPECT_NEAR(errors.rms * errors.rms * static_cast<double>(errors.lines), squares, 0.02 * squares);
  EXPECT_NEAR(std::max(errors.max, errors.rim_max), greatest, 0.02);
}

TEST(Judge, VerticalErrorsAreThoseAtThePosts) {
  const Grid grid = RandomGrid(6, 5, 3);
  const Mesh tent = Tent(grid, {2.3, 1.6, 9});
  double squares = 0, greatest = 0;
  for (std::size_t post = 0; post < grid.heights.size(); ++post) {
    const Point p = grid.PointAt(post);
    const double error = std::abs(HeightOver(tent, p.x, p.y).height - p.z);
    squares += error * error;
    greatest = std::max(greatest, error);
  }
  const VerticalErrors errors = VerticalErrorsOf(tent, grid);
  EXPECT_NEAR(errors.max, greatest, 1e-9);
  EXPECT_NEAR(errors.rms, std::sqrt(squares / 30), 1e-9);
}

TEST(Judge, ARoundedOutlineStillCoversThePostsOnIt) {
  Grid grid{3, 3, std::vector<float>(9, 5)};
  Mesh mesh{{{0.04, 0.03, 5}, {1.97, 0.02, 5}, {1.96, 1.98, 5}, {0.01, 1.95, 5}},
            {{0, 1, 2}, {0, 2, 3}}};
  EXPECT_EQ(VerticalErrorsOf(mesh, grid).uncovered, 0);
  mesh.vertices[1].x = 1.8;  // 0.12 cells off the middle post of that side
  EXPECT_EQ(VerticalErrorsOf(mesh, grid).uncovered, 2);
}

TEST(Judge, ACellWithOneMissingPostKeepsItsTriangle) {
  Grid grid{3, 3, {0, 0, 0, 0, kMissing, 0, 0, 0, 0}};
  EXPECT_EQ(FullMesh(grid).triangles.size(), 4u);
  grid.heights = {kMissing, 0, 0, 0, 0, 0, 0, 0, 0};
  EXPECT_EQ(FullMesh(grid).triangles.size(), 7u);
  EXPECT_EQ(VerticalErrorsOf(FullMesh(grid), grid).uncovered, 0);
  EXPECT_EQ(VerticalErrorsOf({}, grid).uncovered, 8);
}

TEST(Judge, FacetAnglesAreBetweenNormalsInMetres) {
  Grid slope{4, 4, {}};
  for (int i = 0; i < 16; ++i) slope.heights.push_back(static_cast<float>(30 * (i % 4)));
  const Mesh level{{{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}}, {{0, 1, 2}, {2, 3, 0}}};
  EXPECT_NEAR(FacetAngleRms(level, slope, {30, 10}), 45, 1e-9);
  EXPECT_NEAR(FacetAngleRms(level, slope, {30 / std::sqrt(3.), 10}), 60, 1e-9);
}

TEST(Judge, NeedlesAreTrianglesWithAnAngleBelowTwoDegrees) {
  const double thin = std::tan(1.9 * std::numbers::pi / 180);
  const double wide = std::tan(2.1 * std::numbers::pi / 180);
  const Mesh mesh{{{0, 0, 0}, {10, 0, 0}, {10, 10 * thin, 0}, {10, 10 * wide, 0}},
                  {{0, 1, 2}, {0, 1, 3}}};
  EXPECT_EQ(NeedleShare(mesh, {1, 1}, 2), 0.5);
  EXPECT_EQ(NeedleShare(mesh, {1, 2}, 2), 0);
  EXPECT_EQ(NeedleShare({}, {1, 1}, 2), 0);
}

}  // namespace farhorizon::peers

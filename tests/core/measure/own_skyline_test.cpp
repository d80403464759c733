#include "core/measure/own_skyline.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <stop_token>

#include <gtest/gtest.h>

#include "core/measure/mesh_sides.h"
#include "tests/support/drawn_dem.h"
#include "tests/support/measured_meshes.h"

namespace farhorizon {
namespace {

using Pairs = std::vector<std::array<std::int32_t, 2>>;

Pairs PairsOf(const OwnSkyline& skyline) {
  Pairs pairs;
  for (const SkylineSide& side : skyline.sides) pairs.push_back({side.a, side.b});
  return pairs;
}

// A line with the points (x, y) of cosine * y - sine * x = offset.
struct UniformLine {
  double sine, cosine, offset;
};

// The greatest height of the pairs over a line; minus infinity where it meets none.
double HeightOfSkyline(const GridMesh& mesh, const Pairs& pairs, const UniformLine& line) {
  double height = -std::numeric_limits<double>::infinity();
  for (const auto& [i, j] : pairs) {
    const GridPoint& a = mesh.points[static_cast<std::size_t>(i)];
    const GridPoint& b = mesh.points[static_cast<std::size_t>(j)];
    const double of_a = line.cosine * a.row - line.sine * a.column - line.offset;
    const double of_b = line.cosine * b.row - line.sine * b.column - line.offset;
    if ((of_a > 0) == (of_b > 0)) continue;
    height = std::max(height, std::lerp(a.height_m, b.height_m, of_a / (of_a - of_b)));
  }
  return height;
}

// Of lines drawn uniformly in the measure of lines, the share on which some pair is as high as the
// mesh, by definition: every side of every triangle is asked.
double ShareOn(const GridMesh& mesh, const Pairs& pairs, double reach) {
  constexpr int kLines = 2000;
  Pairs all;
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) all.push_back({t[k], t[(k + 1) % 3]});
  }
  std::mt19937 random(27);
  const auto draw = [&random] { return static_cast<double>(random()) / 4294967296.0; };
  int met = 0;
  int on = 0;
  while (met < kLines) {
    const double t = std::numbers::pi * draw();
    const UniformLine line = {std::sin(t), std::cos(t), 1.5 * reach * (2 * draw() - 1)};
    const double height = HeightOfSkyline(mesh, all, line);
    if (std::isinf(height)) continue;
    ++met;
    on += HeightOfSkyline(mesh, pairs, line) >= height - 2e-6 ? 1 : 0;
  }
  return static_cast<double>(on) / kLines;
}

RunControl control;

TEST(OwnSkyline, HasNearlyAllOfTheSkylineByDefinition) {
  for (const std::uint32_t seed : {1U, 5U, 6U}) {
    const Dem dem = FractalDem(4, seed);
    std::mt19937 random(seed);
    GridMesh mesh = CoarseMesh(dem, random);
    Shake(mesh, 0.1, 2, random);
    const OwnSkyline found = *FindOwnSkyline(mesh, {}, 1, control);
    EXPECT_LT(found.missed_share, 2 * kMissedShare);
    EXPECT_LT(found.sides.size(), SidesOf(mesh).sides.size() * 2 / 3);
    EXPECT_GE(ShareOn(mesh, PairsOf(found), 16), 0.995);
    // The test sees it where some are missing.
    Pairs some = PairsOf(found);
    some.resize(some.size() * 9 / 10);
    EXPECT_LT(ShareOn(mesh, some, 16), 0.99);
  }
}

// A cone of narrow triangles: each edge down its side is on the skyline from a third of a degree,
// over many lines side by side.
TEST(OwnSkyline, DirectionsBetweenThoseSampledMissLittle) {
  constexpr std::int32_t kSpokes = 600;
  GridMesh cone;
  cone.points.push_back({20.3, 20.4, 100});
  for (std::int32_t i = 0; i < kSpokes; ++i) {
    const double t = 2 * std::numbers::pi * i / kSpokes;
    cone.points.push_back({20.3 + 20 * std::cos(t), 20.4 + 20 * std::sin(t), 20});
    cone.triangles.push_back({0, i + 1, (i + 1) % kSpokes + 1});
  }
  const OwnSkyline found = *FindOwnSkyline(cone, {}, 1, control);
  EXPECT_GE(ShareOn(cone, PairsOf(found), 30), 0.99);
  EXPECT_LE(found.missed_share, kMissedShare);
}

TEST(OwnSkyline, EachSideThatIsNotKnownIsShownByALine) {
  const Dem dem = FractalDem(3, 2);
  const GridMesh mesh = MeshOf(*Terrain::Build(dem));
  const OwnSkyline alone = *FindOwnSkyline(mesh, {}, 1, control);
  for (const SkylineSide& side : alone.sides) {
    EXPECT_GT(side.lines, 0);
    EXPECT_NE(side.directions, 0U);
  }
  const MeshSides sides = SidesOf(mesh);
  Pairs known;
  for (std::size_t i = 0; i < sides.sides.size(); i += 3) {
    known.push_back({sides.sides[i].a, sides.sides[i].b});
  }
  known.push_back({0, 70});  // no side
  const OwnSkyline with = *FindOwnSkyline(mesh, known, 1, control);
  known.pop_back();
  Pairs expected = PairsOf(alone);
  expected.insert(expected.end(), known.begin(), known.end());
  std::ranges::sort(expected);
  expected.erase(std::unique(expected.begin(), expected.end()), expected.end());
  EXPECT_EQ(PairsOf(with), expected);
}

TEST(OwnSkyline, AValleyIsNotInItAndALevelPlainHasFewSides) {
  // Two ridges along the columns, a valley between, seen across and not along: its floor ends at
  // the rim, where a line along it has its skyline.
  GridMesh mesh;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 5; ++column) {
      mesh.points.push_back({column * 4.0, row * 9.0, column % 2 == 1 ? 50.0 : 0.0});
    }
  }
  for (std::int32_t row = 0; row < 2; ++row) {
    for (std::int32_t column = 0; column < 4; ++column) {
      const std::int32_t nw = row * 5 + column;
      mesh.triangles.push_back({nw, nw + 6, nw + 1});
      mesh.triangles.push_back({nw, nw + 5, nw + 6});
    }
  }
  const Pairs pairs = PairsOf(*FindOwnSkyline(mesh, {}, 1, control));
  EXPECT_TRUE(std::ranges::binary_search(pairs, std::array{1, 6}));
  EXPECT_TRUE(std::ranges::binary_search(pairs, std::array{3, 8}));
  EXPECT_FALSE(std::ranges::binary_search(pairs, std::array{2, 7}));
  // Level ground: every side is as high as every other, and the outline is enough.
  for (GridPoint& p : mesh.points) p.height_m = 7;
  EXPECT_LE(FindOwnSkyline(mesh, {}, 1, control)->sides.size(), 14U);
}

TEST(OwnSkyline, ThreadsDoNotMatter) {
  const Dem dem = FractalDem(4, 8);
  std::mt19937 random(1);
  const GridMesh mesh = CoarseMesh(dem, random);
  const OwnSkyline one = *FindOwnSkyline(mesh, {}, 1, control);
  const OwnSkyline three = *FindOwnSkyline(mesh, {}, 3, control);
  EXPECT_EQ(PairsOf(one), PairsOf(three));
  EXPECT_EQ(one.lines, three.lines);
  EXPECT_EQ(one.missed_share, three.missed_share);
  for (std::size_t i = 0; i < one.sides.size(); ++i) {
    EXPECT_EQ(one.sides[i].lines, three.sides[i].lines);
    EXPECT_EQ(one.sides[i].directions, three.sides[i].directions);
  }
}

TEST(OwnSkyline, AStopIsAnError) {
  const auto source = std::make_unique<std::stop_source>();
  source->request_stop();
  RunControl stopped;
  stopped.stop = source->get_token();
  const Dem dem = FractalDem(2, 5);
  Result<OwnSkyline> found = FindOwnSkyline(MeshOf(*Terrain::Build(dem)), {}, 1, stopped);
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, ErrorCode::kCancelled);
}

}  // namespace
}  // namespace farhorizon

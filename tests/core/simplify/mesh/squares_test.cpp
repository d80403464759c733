#include "core/simplify/mesh/squares.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/simplify/mesh/half_edge_mesh.h"
#include "tests/support/ascii_dem.h"
#include "tests/support/effort.h"
#include "tests/support/level_sums.h"
#include "tests/support/random_operations.h"
#include "tests/support/small_terrains.h"
#include "tests/support/terrains.h"

namespace farhorizon {
namespace {

constexpr double kFloat = 1e-5;  // relative, of sums of floats

float AnyHeight(std::mt19937& random) {
  return static_cast<float>(static_cast<std::int32_t>(random() % 2001) - 1000);
}

// New heights for all vertices but knots and corners of the rim, which keep theirs.
void ShakeHeights(HalfEdgeMesh& mesh, std::mt19937& random) {
  for (std::int32_t v = 0; v < mesh.vertices(); ++v) {
    if (!mesh.IsVertex(v) || mesh.IsKnotted(v)) continue;
    if (mesh.OnRim(v) && !RimIsStraight(mesh, v)) continue;
    const Place& at = mesh.at(v);
    mesh.SetPlace(v, mesh.ground().WithHeight(at.x, at.y, at.plan + AnyHeight(random)));
  }
}

TEST(PostSquares, OfAllTrianglesAndTheRimHaveEveryPostOfTheDomainOnce) {
  std::mt19937 random(1);
  for (int round = 0; round < Rounds(3000); ++round) {
    const Dem dem = AnySmallDem(12, random);
    const Terrain terrain = *Terrain::Build(dem);
    const Ground ground(terrain, {round % 2 * 0.5, round % 3 * 0.25});
    HalfEdgeMesh mesh(ground);
    Rearrange(mesh, 150, random);
    ShakeHeights(mesh, random);
    const double weight = round % 4 * 0.25;
    mesh.measure().SetSlopeWeight(static_cast<float>(weight));
    const double wanted = SquaresByDefinition(mesh, weight);
    ASSERT_NEAR(SquaresOf(mesh), wanted, kFloat * (1 + wanted)) << DrawAscii(dem);
  }
}

TEST(PostSquares, OfAMeshOfAllTrianglesAreZero) {
  std::mt19937 random(5);
  for (int round = 0; round < Rounds(1000); ++round) {
    const Dem dem = AnySmallDem(12, random);
    const Terrain terrain = *Terrain::Build(dem);
    const Ground ground(terrain, {});
    HalfEdgeMesh mesh(ground);
    mesh.measure().SetSlopeWeight(1);
    mesh.measure().SetMost(0);
    ASSERT_EQ(SquaresOf(mesh), 0) << DrawAscii(dem);
  }
}

TEST(PostSquares, KnowTheDemsDiagonalFromTheOther) {
  const Dem dem = AsciiDem("0 0\n0 6");
  const Terrain terrain = *Terrain::Build(dem);
  const Ground ground(terrain, {});
  PostSquares measure(ground);
  measure.SetSlopeWeight(0.5F);
  const Place nw = ground.At(0, 0);
  const Place ne = ground.At(1, 0);
  const Place sw = ground.At(0, 1);
  const Place se = ground.At(1, 1);
  EXPECT_EQ(measure.Of(nw, ne, se), 0);
  EXPECT_EQ(measure.Of(nw, se, sw), 0);
  // Centroids lie on the other diagonal, so the triangle right of it has both: it rises by 6 along
  // both axes, where each facet rises along one.
  EXPECT_EQ(measure.Of(nw, ne, sw), 0);
  EXPECT_EQ(measure.Of(ne, se, sw), 0.5F * 0.5F * (36 + 36));
}

TEST(PostSquares, OfALevelSeaAreTheEarthsDrop) {
  const Dem dem = MakeDem(9, 9, [](std::int32_t, std::int32_t) { return 0; });
  const Terrain terrain = *Terrain::Build(dem);
  const Ground ground(terrain, {0.25, 0});
  // The triangle is level with the tile's left side, 4 m below the middle column.
  float sum = 0;
  for (std::int32_t y = 0; y < 8; ++y) {
    for (std::int32_t x = 0; x < y; ++x) {
      const double off = 4 - 0.25 * (x - 4) * (x - 4);
      sum += static_cast<float>(off * off);
    }
  }
  const PostSquares measure(ground);
  EXPECT_NEAR(measure.Of(ground.At(0, 0), ground.At(8, 8), ground.At(0, 8)), sum, 1e-3);
}

TEST(PostSquares, AreInfiniteWhereAPostIsOffByMoreThanTheMost) {
  std::mt19937 random(2);
  int infinite = 0;
  int finite = 0;
  for (int round = 0; round < Rounds(2000); ++round) {
    const Dem dem = AnySmallDem(9, random);
    const Terrain terrain = *Terrain::Build(dem);
    const Ground ground(terrain, {});
    HalfEdgeMesh mesh(ground);
    Rearrange(mesh, 80, random);
    ShakeHeights(mesh, random);
    const auto most = static_cast<float>(random() % 2000);
    const double greatest = GreatestErrorByDefinition(mesh);
    if (std::abs(greatest - static_cast<double>(most)) < kFloat * (1 + greatest)) continue;
    mesh.measure().SetMost(most);
    const bool found = std::isinf(SquaresOf(mesh));
    ASSERT_EQ(found, greatest > static_cast<double>(most)) << DrawAscii(dem);
    infinite += static_cast<int>(found);
    finite += static_cast<int>(!found);
  }
  EXPECT_GT(infinite, Rounds(100));
  EXPECT_GT(finite, Rounds(100));
}

TEST(PostSquares, AreChangedByOneHeightAsItsPullSays) {
  std::mt19937 random(3);
  const Dem dem = FractalDem(17, 500, 120, 4);
  const Terrain terrain = *Terrain::Build(dem);
  const Ground ground(terrain, {0.25, 0.5});
  PostSquares measure(ground);
  const auto any = [&] {
    const auto x = static_cast<std::int32_t>(random() % 17);
    const auto y = static_cast<std::int32_t>(random() % 17);
    return ground.WithHeight(x, y, ground.At(x, y).plan + AnyHeight(random));
  };
  int rounds = 0;
  while (rounds < Rounds(20000)) {
    const Place a = any();
    const Place b = any();
    const Place c = any();
    if (Turn(a, b, c) <= 0) continue;
    ++rounds;
    HeightPull sum = {3, 5, 7};
    measure.SetSlopeWeight(static_cast<float>(rounds % 3));
    measure.AddPull(a, b, c, sum);
    const double pull = static_cast<double>(sum.pull) - 3;
    const double stiffness = static_cast<double>(sum.stiffness) - 5;
    const auto change = static_cast<double>(AnyHeight(random));
    const Place to = ground.WithHeight(a.x, a.y, a.plan + static_cast<float>(change));
    const double before = measure.Of(a, b, c);
    ASSERT_NEAR(static_cast<double>(sum.sum) - 7, before, kFloat * (1 + before));
    const double after = measure.Of(to, b, c);
    ASSERT_NEAR(after - before, -2 * change * pull + change * change * stiffness,
                1e-4 * (1 + before + after));
  }
}

TEST(PostSquares, OfTheRimAreOnlyWhatNoTriangleHas) {
  const Dem dem = MakeDem(5, 5, [](std::int32_t c, std::int32_t r) { return c * c + 10 * r * r; });
  const Terrain terrain = *Terrain::Build(dem);
  const Ground ground(terrain, {});
  // Posts inside edges of the tile's right and lower sides are off by 3, 4, 3 and 30, 40, 30.
  PostSquares measure(ground);
  EXPECT_EQ(measure.OfRim(ground.At(0, 0), ground.At(4, 0)), 0);
  EXPECT_EQ(measure.OfRim(ground.At(4, 0), ground.At(4, 4)), 900 + 1600 + 900);
  EXPECT_EQ(measure.OfRim(ground.At(4, 4), ground.At(0, 4)), 9 + 16 + 9);
  EXPECT_EQ(measure.OfRim(ground.At(0, 4), ground.At(0, 0)), 0);
  measure.SetMost(3.5F);
  EXPECT_TRUE(std::isinf(measure.OfRim(ground.At(4, 4), ground.At(0, 4))));
  measure.SetMost(4);
  EXPECT_FALSE(std::isinf(measure.OfRim(ground.At(4, 4), ground.At(0, 4))));
}

}  // namespace
}  // namespace farhorizon

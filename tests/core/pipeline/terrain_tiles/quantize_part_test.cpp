#include "core/pipeline/terrain_tiles/quantize_part.h"

#include <cmath>

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

constexpr TileAddress kTile = {10, 1100, 800};
const std::int64_t kSide = TileSide(10);

// A vertex at shares of the tile's sides.
GlobeVertex At(double east, double north, double height_m, bool is_ground = true) {
  return {{kTile.x * kSide + std::llround(east * static_cast<double>(kSide)),
           kTile.y * kSide + std::llround(north * static_cast<double>(kSide))},
          height_m,
          {0, 0, 1},
          0,
          is_ground};
}

QuantizedPart Square(const std::vector<double>& heights, double step_m) {
  const std::vector<GlobeVertex> vertices = {At(0, 0, heights[0]), At(1, 0, heights[1]),
                                             At(1, 1, heights[2]), At(0, 1, heights[3]),
                                             At(0.5, 0.5, heights[4])};
  return QuantizePart(kTile, {{{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}, {}}, vertices, step_m);
}

TEST(QuantizePart, HeightsOnSidesAreMultiplesOfTheStepInAnyTile) {
  const double step_m = HeightStepOf(-37, 4810);
  for (const double inside : {500.0, 4800.0, -36.5}) {
    const QuantizedPart part = Square({123.4567, 130.1, 127.77, 120.3, inside}, step_m);
    for (std::size_t i = 0; i < 4; ++i) {
      const double height_m = PlaceOf(part.tile, part.tile.vertices[i]).height_m;
      EXPECT_NEAR(std::remainder(height_m, step_m), 0, 1e-9);
    }
    double furthest = 0;
    for (const QuantizedVertex& v : part.tile.vertices) {
      if (v.u == 0 || v.u == kMostQuantized) continue;
      furthest = std::abs(PlaceOf(part.tile, v).height_m - inside);
    }
    EXPECT_LE(furthest, step_m / 2);
  }
}

TEST(QuantizePart, AFlatTileHasFineHeights) {
  const QuantizedPart part = Square({800.3, 800.3, 800.3, 800.3, 801.1}, HeightStepOf(0, 8000));
  for (const QuantizedVertex& v : part.tile.vertices) {
    if (v.u == 0 || v.u == kMostQuantized) continue;
    EXPECT_NEAR(PlaceOf(part.tile, v).height_m, 801.1, 0x1p-11);
  }
}

TEST(QuantizePart, TheHeaderHoldsItsHeightsWithoutRounding) {
  const QuantizedPart part = Square({0.3, 812.7, 411.3, 0.1, 977.9}, HeightStepOf(-105, 8800));
  const double step_m = (double{part.tile.heights_m[1]} - part.tile.heights_m[0]) / kMostQuantized;
  EXPECT_EQ(step_m, std::exp2(std::round(std::log2(step_m))));
}

TEST(QuantizePart, WhatIsOnNoSideIsPutOnNone) {
  std::vector<GlobeVertex> vertices = {At(0, 0, 5), At(1, 0, 5), At(1, 1, 5), At(0, 1, 5)};
  vertices.push_back(At(1e-7, 0.5, 9));
  const QuantizedPart part = QuantizePart(kTile, {{{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}, {}},
                                          vertices, HeightStepOf(0, 9));
  for (const QuantizedVertex& v : part.tile.vertices) {
    if (v.v == 0 || v.v == kMostQuantized) continue;
    EXPECT_EQ(v.u, 1);
  }
}

TEST(QuantizePart, GroundOnOnePlaceKeepsItsHighest) {
  std::vector<GlobeVertex> vertices = {At(0, 0, 5), At(1, 0, 5), At(1, 1, 5), At(0, 1, 5)};
  vertices.push_back(At(0.5, 0.5, 40));
  vertices.push_back(At(0.5 + 1e-6, 0.5, 90));
  const QuantizedPart part =
      QuantizePart(kTile, {{{0, 1, 4}, {1, 5, 4}, {1, 2, 5}, {2, 3, 5}, {3, 4, 5}, {3, 0, 4}}, {}},
                   vertices, HeightStepOf(0, 90));
  EXPECT_EQ(part.tile.vertices.size(), 5U);
  EXPECT_EQ(part.tile.triangles.size(), 4U);
  double highest = 0;
  for (const QuantizedVertex& v : part.tile.vertices) {
    highest = std::max(highest, PlaceOf(part.tile, v).height_m);
  }
  EXPECT_NEAR(highest, 90, 0.01);
  EXPECT_GE(part.moved_m, 50);
}

}  // namespace
}  // namespace farhorizon

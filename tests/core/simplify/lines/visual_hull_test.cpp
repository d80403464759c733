#include "core/simplify/lines/visual_hull.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/effort.h"
#include "tests/support/small_terrains.h"
#include "tests/support/workbench.h"

namespace farhorizon {
namespace {

// By how much the edge is above the DEM's skyline over a sampled line, the most; from all lines.
float RiseOf(const SampledSkyline& skyline, const Place& a, const Place& b) {
  float most = -1e30F;
  skyline.pencils().ForEachLineAcross(a, b, [&](std::int32_t line, float height) {
    if (skyline.Meets(line)) most = std::max(most, height - skyline.dem()[line]);
  });
  return most;
}

// A place near the skyline's height, somewhere around (x, y).
Place AnyHullPlace(const Workbench& bench, std::int32_t x, std::int32_t y, std::int32_t around,
                   std::mt19937& random) {
  const Ground& ground = bench.ground;
  const auto beside = [&](std::int32_t at, std::int32_t count) {
    const auto step = static_cast<std::int32_t>(random() % static_cast<unsigned>(2 * around + 1));
    return std::clamp(at + step - around, 0, count - 1);
  };
  const std::int32_t column = beside(x, ground.columns());
  const std::int32_t row = beside(y, ground.rows());
  float z = 0;
  if (ground.HasData(column, row)) z = ground.At(column, row).plan;
  return ground.WithHeight(column, row, z + static_cast<float>(random() % 9) - 4);
}

TEST(VisualHull, NoEdgeBelowItsLeastAroundRisesAboveASampledLine) {
  std::mt19937 random(1);
  int ruled_out = 0;
  for (int round = 0; round < Rounds(600); ++round) {
    const Workbench bench(AnySmallDem(14, random));
    const Ground& ground = bench.ground;
    const SampledSkyline& skyline = bench.work.skyline;
    const VisualHull hull(ground, skyline.pencils(), skyline.dem());
    for (int k = 0; k < 40; ++k) {
      const auto x = static_cast<std::int32_t>(random() % static_cast<unsigned>(ground.columns()));
      const auto y = static_cast<std::int32_t>(random() % static_cast<unsigned>(ground.rows()));
      const auto reach = static_cast<std::int32_t>(1 + random() % 9);
      const Place centre = AnyHullPlace(bench, x, y, 0, random);
      std::array<Place, 5> places;
      for (Place& place : places) place = AnyHullPlace(bench, x, y, reach, random);
      if (hull.MayRiseAround(centre, places.data(), 5)) continue;
      ++ruled_out;
      for (const Place& p : places) {
        ASSERT_LE(RiseOf(skyline, centre, p), 1e-3);
        for (const Place& q : places) ASSERT_LE(RiseOf(skyline, p, q), 1e-3);
      }
    }
  }
  EXPECT_GT(ruled_out, Rounds(200));
}

TEST(VisualHull, AnEdgeThatMayNotRiseHardlyEverRisesByMoreThanItDoesInHalfAStep) {
  std::mt19937 random(2);
  int missed = 0;
  int noticed = 0;
  int ruled_out = 0;
  for (int round = 0; round < Rounds(600); ++round) {
    const Workbench bench(AnySmallDem(14, random));
    const Ground& ground = bench.ground;
    const SampledSkyline& skyline = bench.work.skyline;
    const VisualHull hull(ground, skyline.pencils(), skyline.dem());
    for (int k = 0; k < 60; ++k) {
      const Place a = AnyHullPlace(bench, 0, 0, 14, random);
      const Place b = AnyHullPlace(bench, a.x, a.y, 6, random);
      const int steps = std::max(std::abs(a.x - b.x), std::abs(a.y - b.y));
      if (steps == 0) continue;
      const float in_half_a_step = std::abs(a.plan - b.plan) / static_cast<float>(2 * steps);
      const bool rises = RiseOf(skyline, a, b) > 1e-3F + in_half_a_step;
      const bool may = hull.MayRise(a, b);
      ruled_out += static_cast<int>(!may);
      noticed += static_cast<int>(rises && may);
      missed += static_cast<int>(rises && !may);
    }
  }
  // A line may pass the nearest post by a little more than a cell.
  EXPECT_LE(missed, noticed / 500);
  EXPECT_GT(noticed, Rounds(1000));
  EXPECT_GT(ruled_out, Rounds(1000));
}

}  // namespace
}  // namespace farhorizon

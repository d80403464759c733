#include "core/simplify/lines/sampled_skyline.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/simplify/order/collapser.h"
#include "core/simplify/polish/polish.h"
#include "core/simplify/sides/side_thinner.h"
#include "core/terrain/height_range.h"
#include "tests/support/ascii_dem.h"
#include "tests/support/effort.h"
#include "tests/support/half_edge_checks.h"
#include "tests/support/level_sums.h"
#include "tests/support/small_terrains.h"
#include "tests/support/workbench.h"

namespace farhorizon {
namespace {

// What floats may lose of a height between two posts, metres.
double RoundingOn(const Workbench& bench) {
  const HeightRange range = HeightRangeOf(bench.dem);
  return 1e-3 + 1e-6 * (static_cast<double>(range.greatest) - range.least);
}

// visit(number, bracket of the mesh's height over it) for every line that counts.
template <typename Visit>
void ForEachLine(const Workpiece& work, Visit visit) {
  for (const Pencils::Pencil& pencil : work.skyline.pencils().pencils()) {
    for (std::int32_t i = 0; i < pencil.count; ++i) {
      visit(pencil.first + i, HeightOverByDefinition(work.mesh, pencil, i));
    }
  }
}

TEST(SampledSkyline, HasTheGreatestHeightOfAllEdgesFromTheHorizonEdgesAlone) {
  std::mt19937 random(1);
  int lines = 0;
  for (int round = 0; round < Rounds(1500); ++round) {
    const Workbench bench(AnySmallDem(10, random));
    ForEachLine(bench.work, [&](std::int32_t line, const HeightBracket& wanted) {
      const double dem = bench.work.skyline.dem()[line];
      const double rounding = RoundingOn(bench);
      if (std::isinf(wanted.most)) {
        ASSERT_FALSE(bench.work.skyline.Meets(line));
        return;
      }
      if (std::isinf(wanted.least)) return;
      ASSERT_GE(dem, wanted.least - rounding) << DrawAscii(bench.dem);
      ASSERT_LE(dem, wanted.most + rounding) << DrawAscii(bench.dem);
      ASSERT_EQ(bench.work.skyline.top(line), bench.work.skyline.dem()[line]);
      ++lines;
    });
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(lines, Rounds(100000));
}

struct Upkeep {
  std::int64_t lines = 0;
  std::int64_t below = 0;  // lines whose top is lower than the mesh
};

void LookAtTops(const Workbench& bench, Upkeep& upkeep, const char* step) {
  ForEachLine(bench.work, [&](std::int32_t line, const HeightBracket& mesh) {
    if (!bench.work.skyline.Counts(line) || std::isinf(mesh.least)) return;
    const double top = bench.work.skyline.top(line);
    const double rounding = RoundingOn(bench);
    ASSERT_LE(top, mesh.most + rounding) << step << DrawAscii(bench.dem);
    ++upkeep.lines;
    if (top < mesh.least - rounding) ++upkeep.below;
  });
}

// All steps of a level, whatever they cost.
void MakeLevel(Workbench& bench, const SidePosts& sides, double share, Upkeep& upkeep) {
  Workpiece& work = bench.work;
  Collapser collapser(work);
  work.rules.BeginSoft(work.mesh);
  work.price.AllowRises(true);
  work.price.SetWeight(static_cast<float>(30 * work.skyline.PostsPerLine()));
  const std::vector<SidePosts::Height> staying = sides.At(share);
  SideThinner(work, collapser).Thin(staying);
  LookAtTops(bench, upkeep, "thinned");
  for (std::int32_t v = 0; v < work.mesh.vertices(); ++v) collapser.Consider(v);
  ASSERT_TRUE(collapser.Run(work.mesh.triangles() / 3, {}, [] {}));
  LookAtTops(bench, upkeep, "collapsed");
  ASSERT_TRUE(FlipEdges(work, {}));
  LookAtTops(bench, upkeep, "flipped");
  ASSERT_TRUE(MoveVertices(work, {}));
  LookAtTops(bench, upkeep, "moved");
  ASSERT_TRUE(FitHeights(work, {}));
  LookAtTops(bench, upkeep, "fitted");
  SideThinner(work, collapser).Finish(staying);
  LookAtTops(bench, upkeep, "finished");
  work.mesh.Compact();
}

TEST(SampledSkyline, IsNeverAboveTheMeshAndSeldomBelowIt) {
  std::mt19937 random(2);
  Upkeep upkeep;
  for (int round = 0; round < Rounds(700); ++round) {
    Workbench bench(AnySmallDem(14, random));
    const SidePosts sides(bench.terrain);
    for (const double share : {0.7, 0.4, 0.1}) {
      MakeLevel(bench, sides, share, upkeep);
      if (HasFatalFailure()) FAIL() << "round " << round << ", share " << share;
      ASSERT_EQ(FaultOfMesh(bench.work.mesh), "") << DrawAscii(bench.dem);
    }
  }
  EXPECT_GT(upkeep.lines, Rounds(1000000));
  EXPECT_LT(static_cast<double>(upkeep.below), 0.03 * static_cast<double>(upkeep.lines));
}

TEST(SampledSkyline, ThinsByHalvesWhileEnoughLinesRemain) {
  std::mt19937 random(3);
  Workbench bench(AnySmallDem(12, random));
  SampledSkyline& skyline = bench.work.skyline;
  const auto count = [&] {
    std::int64_t lines = 0;
    for (std::int32_t line = 0; line < skyline.pencils().lines(); ++line) {
      lines += skyline.Counts(line) ? 1 : 0;
    }
    return lines;
  };
  const std::int64_t all = count();
  skyline.Thin(all);
  EXPECT_EQ(count(), all);
  skyline.Thin(all / 5);
  EXPECT_GE(count(), all / 5);
  EXPECT_LT(count(), 2 * (all / 5) + 2);
  EXPECT_DOUBLE_EQ(skyline.PostsPerLine(),
                   static_cast<double>(bench.work.mesh.vertices()) / static_cast<double>(count()));
}

}  // namespace
}  // namespace farhorizon

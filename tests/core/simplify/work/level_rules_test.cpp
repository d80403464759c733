#include "core/simplify/work/level_rules.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "core/terrain/height_range.h"
#include "tests/support/ascii_dem.h"
#include "tests/support/effort.h"
#include "tests/support/exact_skyline.h"
#include "tests/support/small_terrains.h"
#include "tests/support/workbench.h"

namespace farhorizon {
namespace {

TEST(LevelRules, AnExactLevelAllowsOnlyEdgesThatRiseAboveNoLine) {
  std::mt19937 random(1);
  int allowed = 0;
  int refused = 0;
  int risen = 0;  // refused, and a random line shows why
  for (int round = 0; round < Rounds(400); ++round) {
    Workbench bench(AnySmallDem(8, random));
    // An edge must lie in the domain to be asked.
    if (std::count(bench.dem.heights.begin(), bench.dem.heights.end(), kNoHeight) > 0) continue;
    LevelRules& rules = bench.work.rules;
    rules.BeginExact(0);
    const FinerHeights scale = FinerHeights::Centred(HeightRangeOf(bench.dem));
    const std::vector<Segment> ground = ExactEdges(bench.terrain, scale);
    const auto any = [&] {
      for (;;) {
        const auto v =
            static_cast<VertexId>(random() % static_cast<unsigned>(bench.terrain.post_count()));
        if (!bench.terrain.IsVertex(v)) continue;
        const Place p = bench.ground.At(v);
        const float change = random() % 3 == 0 ? static_cast<float>(random() % 7) - 3 : 0;
        return bench.ground.WithHeight(p.x, p.y, p.plan + change);
      }
    };
    for (int k = 0; k < 10; ++k) {
      const Place p = any();
      const Place q = any();
      if (p.x == q.x && p.y == q.y) continue;
      const bool may = rules.Allows(p, q);
      (may ? allowed : refused) += 1;
      const auto steps = [&](const Place& at) {
        const double quanta = (rules.HeightM(at) - bench.dem.height_offset_m) / bench.dem.quantum_m;
        return Point3i{
            at.x, at.y,
            static_cast<std::int32_t>(std::lround(std::ldexp(quanta - scale.zero, scale.bits)))};
      };
      const Segment edge = {steps(p), steps(q)};
      bool rises = false;
      for (int i = 0; i < 60; ++i) {
        const LineEquation<Int128> line =
            AnyLine({edge, ground[random() % ground.size()]}, bench.dem, random);
        const std::optional<Ratio<Int128>> height = HeightOver(line, edge);
        if (!height) continue;
        const std::optional<Ratio<Int128>> dem = GreatestOver(line, ground);
        rises = rises || !dem || *dem < *height;
      }
      if (may) {
        ASSERT_FALSE(rises) << DrawAscii(bench.dem) << bench.ground.PostAt(p) << " at "
                            << rules.HeightM(p) << " to " << bench.ground.PostAt(q) << " at "
                            << rules.HeightM(q);
      }
      risen += static_cast<int>(!may && rises);
    }
  }
  EXPECT_GT(allowed, Rounds(200));
  EXPECT_GT(refused, Rounds(200));
  EXPECT_GT(risen, refused / 4);
}

TEST(LevelRules, HoldTheEndsOfHorizonEdgesAtAnExactLevelOnly) {
  Workbench bench(AsciiDem(".0.\n010\n.0."));  // O1: four slanted edges, all posts are ends
  LevelRules& rules = bench.work.rules;
  rules.BeginExact(0);
  EXPECT_TRUE(rules.IsLocked(4));
  EXPECT_TRUE(rules.MustStay(bench.ground.At(1), bench.ground.At(4)));
  EXPECT_TRUE(rules.MustStay(bench.ground.At(4), bench.ground.At(1)));
  EXPECT_FALSE(rules.MustStay(bench.ground.At(1), bench.ground.At(3)));
  EXPECT_EQ(rules.KeptIn(bench.work.mesh).size(), 4U);
  EXPECT_FALSE(rules.allows_rises());
  rules.BeginSoft(bench.work.mesh);
  EXPECT_FALSE(rules.IsLocked(4));
  EXPECT_FALSE(rules.MustStay(bench.ground.At(1), bench.ground.At(4)));
  EXPECT_TRUE(rules.allows_rises());
}

TEST(LevelRules, AHorizonEdgeThatTheFinerLevelLacksDoesNotComeBack) {
  Workbench bench(AsciiDem("0000\n0550\n0550\n0000"));
  HalfEdgeMesh& mesh = bench.work.mesh;
  const std::vector<std::int32_t> all = bench.work.rules.KeptIn(mesh);
  Ring ring;
  ASSERT_TRUE(mesh.Gather(5, ring));
  mesh.Collapse(ring, 6);
  const std::vector<std::int32_t> kept = bench.work.rules.KeptIn(mesh);
  EXPECT_LT(kept.size(), all.size());
  bench.work.rules.BeginSoft(mesh);
  for (const std::int32_t e : all) {
    const Edge& edge = bench.horizon.edges[static_cast<std::size_t>(e)].edge;
    const bool has = std::binary_search(kept.begin(), kept.end(), e);
    EXPECT_EQ(bench.work.rules.Allows(bench.ground.At(edge.a), bench.ground.At(edge.b)), has);
  }
}

TEST(LevelRules, HeightsAreThePostsOrWholeStepsOfTheGuard) {
  Dem dem = AsciiDem("10 20\n30 47");
  dem.quantum_m = 0.1;
  dem.height_offset_m = 7;
  Workbench bench(dem);
  EXPECT_EQ(bench.work.rules.HeightM(bench.ground.At(1, 1)), dem.HeightM(3));
  const Place lifted = bench.ground.WithHeight(1, 1, bench.ground.At(1, 1).plan + 0.01234F);
  const double steps = (bench.work.rules.HeightM(lifted) - 7) / 0.1 * 1024;
  EXPECT_NEAR(steps, std::round(steps), 1e-6);
  EXPECT_NEAR(bench.work.rules.HeightM(lifted), dem.HeightM(3) + 0.01234, 0.1 / 2048 + 1e-6);
}

}  // namespace
}  // namespace farhorizon

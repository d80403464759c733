// Level 0 is exact: the DEM's skyline over every line, by whole numbers alone.
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "core/horizon/find_horizon.h"
#include "core/simplify/level_mesh.h"
#include "core/simplify/lod_chain.h"
#include "core/simplify/order/collapser.h"
#include "core/simplify/order/take_back_rises.h"
#include "core/simplify/polish/polish.h"
#include "tests/support/ascii_dem.h"
#include "tests/support/effort.h"
#include "tests/support/exact_skyline.h"
#include "tests/support/level_checks.h"
#include "tests/support/small_terrains.h"
#include "tests/support/terrains.h"
#include "tests/support/workbench.h"

namespace farhorizon {
namespace {

std::int64_t taken_back = 0;  // triangles, by all levels made at the end

// An exact level with as few triangles as can be had, or as are asked for.
// at_the_end: edges are asked when all collapses have been made, and some of these taken back.
Lod MakeExact(Workbench& bench, double most_m, std::int32_t triangles, bool at_the_end = false) {
  Workpiece& work = bench.work;
  work.mesh.measure().SetMost(static_cast<float>(most_m));
  work.rules.BeginExact(0);
  work.price.AllowRises(false);
  work.price.SetWeight(30);
  Collapser collapser(work);
  for (std::int32_t v = 0; v < work.mesh.vertices(); ++v) {
    work.stays[static_cast<std::size_t>(v)] =
        work.mesh.IsVertex(v) && (bench.ground.OnSide(work.mesh.at(v)) || !work.IsFree(v));
  }
  for (std::int32_t v = 0; v < work.mesh.vertices(); ++v) collapser.Consider(v);
  if (at_the_end) {
    work.rules.Trust(true);
    collapser.log().Begin(work.mesh);
    Check(collapser.Run(triangles, {}, [] {}).has_value(), "nobody stops a test");
    work.rules.Trust(false);
    const std::int32_t before = work.mesh.triangles();
    Check(TakeBackRises(work, collapser.log(), 2, {}).has_value(), "nobody stops a test");
    taken_back += work.mesh.triangles() - before;
  }
  Check(collapser.Run(triangles, {}, [] {}).has_value(), "nobody stops a test");
  for (const auto& step : {FlipEdges, MoveVertices, FitHeights}) {
    Check(step(work, {}).has_value(), "nobody stops a test");
  }
  return LevelOf(work, {});
}

struct Figures {
  std::int64_t fitted = 0;   // vertices at other heights than their posts'
  std::int64_t removed = 0;  // triangles
};

// Asks `lines` random lines of an exact level.
void ExpectExact(const Terrain& terrain, const Horizon& horizon, const Lod& level, int lines,
                 std::mt19937& random, Figures& figures) {
  const Dem& dem = terrain.dem();
  ASSERT_TRUE(level.exact);
  ASSERT_EQ(FaultOfLevel(terrain, horizon, level, nullptr), "") << DrawAscii(dem);
  const FinerHeights scale = FinerHeights::Centred(HeightRangeOf(dem));
  const std::vector<Segment> wanted = ExactEdges(terrain, scale);
  const std::optional<std::vector<Segment>> found = ExactEdges(dem, scale, level.mesh);
  ASSERT_TRUE(found) << "a height is no whole number of the guard's steps\n" << DrawAscii(dem);
  for (int i = 0; i < lines; ++i) {
    const LineEquation<Int128> line = AnyLine(*found, dem, random);
    const std::optional<Ratio<Int128>> dems = GreatestOver(line, wanted);
    const std::optional<Ratio<Int128>> levels = GreatestOver(line, *found);
    ASSERT_EQ(dems.has_value(), levels.has_value()) << DrawAscii(dem);
    ASSERT_EQ(dems, levels) << DrawAscii(dem);
  }
  for (std::size_t i = 0; i < level.mesh.posts.size(); ++i) {
    figures.fitted += level.mesh.heights_m[i] != dem.HeightM(level.mesh.posts[i]) ? 1 : 0;
  }
  figures.removed += std::ssize(terrain.Triangles()) - std::ssize(level.mesh.triangles);
}

constexpr std::array<double, 4> kErrors = {0, 1, 30, 1e9};

// The chain ends level 0 where held vertices begin to fill it; here it goes on as far as the rules
// let it.
TEST(LodChainExact, AsFarAsTheRulesLetItOnAnySmallTerrain) {
  std::mt19937 random(1);
  Figures figures;
  for (int round = 0; round < Rounds(4000); ++round) {
    const Dem dem = AnySmallDemInQuanta(11, random);
    LodPlan plan;
    plan.max_error_m = kErrors[static_cast<std::size_t>(round % 4)];
    plan.column_bend = round % 3 * 0.1;
    Workbench bench(dem, {plan.column_bend, 0});
    const Lod level = MakeExact(bench, plan.max_error_m, 0, round / 4 % 2 > 0);
    SCOPED_TRACE(round);
    ExpectExact(bench.terrain, bench.horizon, level, 100, random, figures);
    if (HasFatalFailure()) return;
    const double error = GreatestErrorOf(bench.terrain, level.mesh, plan);
    const FinerHeights scale = FinerHeights::Centred(HeightRangeOf(dem));
    const double rounding = scale.Quanta(0.5) * dem.quantum_m;  // of a fitted height
    ASSERT_LE(error, plan.max_error_m * 1.0001 + rounding * 1.001 + 1e-4) << DrawAscii(dem);
  }
  EXPECT_GT(figures.fitted, Rounds(50));
  EXPECT_GT(figures.removed, Rounds(5000));
  EXPECT_GT(taken_back, Rounds(500));
}

TEST(LodChainExact, LevelZeroHasTheSkylineOfTheDemOnLandscapes) {
  std::mt19937 random(4);  // of whose first landscapes some are fitted, too
  Figures figures;
  for (int round = 0; round < Rounds(60); ++round) {
    const Dem dem = AnySolidLandscape(20, 48, random);
    const Terrain terrain = *Terrain::Build(dem);
    const Horizon horizon = *FindHorizon(terrain, {}, {});
    LodPlan plan;
    plan.max_error_m = kErrors[static_cast<std::size_t>(round % 4)];
    const std::vector<Lod> levels = *BuildLodChain(terrain, horizon, plan, {});
    SCOPED_TRACE(round);
    ExpectExact(terrain, horizon, levels[0], 300, random, figures);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(figures.fitted, Rounds(150));
  EXPECT_GT(figures.removed, Rounds(7000));
}

TEST(LodChainExact, ALevelOfTrianglesIsExactWhereTheHorizonFits) {
  std::mt19937 random(3);
  Figures figures;
  int exact = 0;
  for (int round = 0; round < Rounds(100); ++round) {
    const Dem dem = AnySolidLandscape(16, 30, random);
    const Terrain terrain = *Terrain::Build(dem);
    const Horizon horizon = *FindHorizon(terrain, {}, {});
    const auto full = std::ssize(terrain.Triangles());
    LodPlan plan;
    plan.triangles = {full * 9 / 10, full / 2};
    const std::vector<Lod> levels = *BuildLodChain(terrain, horizon, plan, {});
    SCOPED_TRACE(round);
    for (const Lod& level : levels) {
      if (!level.exact) continue;
      ++exact;
      ExpectExact(terrain, horizon, level, 200, random, figures);
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(exact, Rounds(15));
}

TEST(LodChainExact, ALevelThatMayHaveAllTrianglesIsExactOnAnyGround) {
  std::mt19937 random(8);
  const Dem dem = MakeDem(14, 11, [&random](std::int32_t, std::int32_t) {
    return static_cast<std::int32_t>(random() % 50);
  });
  const Terrain terrain = *Terrain::Build(dem);
  const Horizon horizon = *FindHorizon(terrain, {}, {});
  LodPlan plan;
  plan.triangles = {std::ssize(terrain.Triangles())};
  const std::vector<Lod> levels = *BuildLodChain(terrain, horizon, plan, {});
  Figures figures;
  ExpectExact(terrain, horizon, levels[0], 500, random, figures);
}

TEST(LodChainExact, AValleyBetweenTwoRidgesIsNotFilled) {
  // Both ridges kept, triangles from one to the other would be a skyline that the DEM lacks
  // (core/simplify/README.md, section 2).
  const Dem dem = MakeDem(25, 25, [](std::int32_t c, std::int32_t r) {
    const int off = std::min(std::abs(r - 8), std::abs(r - 16));
    return 100 - 25 * off + (c % 5 == 0 ? 0 : 1);
  });
  Workbench bench(dem);
  const Lod level = MakeExact(bench, 1000, 0);
  std::mt19937 random(4);
  Figures figures;
  ExpectExact(bench.terrain, bench.horizon, level, 3000, random, figures);
  EXPECT_GT(figures.removed, 0);
}

TEST(LodChainExact, ACraterIsSimplifiedInsideItsRim) {
  const Dem dem = MakeDem(33, 33, [](std::int32_t c, std::int32_t r) {
    const double off = std::hypot(c - 16, r - 16);
    return static_cast<std::int32_t>(std::lround(100 - 10 * std::abs(off - 10) + (c * 7 + r) % 3));
  });
  Workbench bench(dem);
  const Lod level = MakeExact(bench, 100, 0);
  std::mt19937 random(5);
  Figures figures;
  ExpectExact(bench.terrain, bench.horizon, level, 3000, random, figures);
  EXPECT_LT(std::ssize(level.mesh.triangles), std::ssize(bench.terrain.Triangles()) * 3 / 4);
}

}  // namespace
}  // namespace farhorizon

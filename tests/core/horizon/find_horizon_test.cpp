#include "core/horizon/find_horizon.h"

#include <algorithm>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/oracles/horizon_brute_force.h"
#include "tests/support/ascii_dem.h"
#include "tests/support/effort.h"
#include "tests/support/matchers.h"
#include "tests/support/terrains.h"

namespace farhorizon {
namespace {

Horizon HorizonOf(const Terrain& terrain, int threads = 1) {
  return *FindHorizon(terrain, {.threads = threads}, {});
}

std::vector<Edge> EdgesFound(const Horizon& horizon) {
  std::vector<Edge> edges;
  for (const HorizonEdge& e : horizon.edges) edges.push_back(e.edge);
  return edges;
}

std::vector<Edge> FindEdges(const Terrain& terrain) { return EdgesFound(HorizonOf(terrain)); }

testing::AssertionResult EveryWitnessHolds(const Terrain& terrain, const Horizon& horizon) {
  const std::vector<Segment> all = SegmentsOf(terrain, terrain.Edges());
  for (const HorizonEdge& e : horizon.edges) {
    const Segment segment = SegmentsOf(terrain, {e.edge})[0];
    testing::AssertionResult clear = LineOfSightIsClear(e.witness, segment, all, Ties::kPass);
    if (!clear) return clear << "edge " << e.edge.a << '-' << e.edge.b;
    if (!WitnessHolds(terrain, e.edge, e.witness)) {
      return testing::AssertionFailure() << "WitnessHolds is false for a line that is clear, edge "
                                         << e.edge.a << '-' << e.edge.b;
    }
  }
  return testing::AssertionSuccess();
}

// The n-th DEM of columns x rows posts with heights 0 ... heights - 1.
Dem NthDem(std::int32_t columns, std::int32_t rows, std::int32_t heights, std::int32_t n) {
  return MakeDem(columns, rows, [&](std::int32_t, std::int32_t) {
    const std::int32_t height = n % heights;
    n /= heights;
    return height;
  });
}

void ExpectTheDefinitionOnEvery(std::int32_t columns, std::int32_t rows, std::int32_t heights) {
  std::int32_t count = 1;
  for (std::int32_t i = 0; i < columns * rows; ++i) count *= heights;
  for (std::int32_t n = 0; n < count; ++n) {
    ASSERT_TRUE(MatchesBruteForce(NthDem(columns, rows, heights, n), FindEdges)) << "number " << n;
  }
}

void ExpectTheDefinitionOnRandomTerrains(std::int32_t min_side, std::int32_t max_side, int rounds,
                                         std::uint32_t seed) {
  std::mt19937 random(seed);
  for (int round = 0; round < rounds; ++round) {
    const Dem dem = AnyRandomDem(min_side, max_side, random);
    ASSERT_TRUE(MatchesBruteForce(dem, FindEdges)) << "round " << round;
  }
}

TEST(FindHorizon, FindsTheKnownHorizonsOfTheNamedTerrains) {
  for (const NamedTerrain& named : NamedTerrains()) {
    EXPECT_TRUE(MatchesBruteForce(named.dem, FindEdges)) << named.name;
    if (named.horizon_edges < 0) continue;
    EXPECT_EQ(static_cast<int>(FindEdges(*Terrain::Build(named.dem)).size()), named.horizon_edges)
        << named.name;
  }
}

TEST(FindHorizon, FindsEveryAxisEdgeOfALargeDome) {
  const Dem dem = Paraboloid(65, -1);
  EXPECT_EQ(FindEdges(*Terrain::Build(dem)).size(), 8320U);
}

TEST(FindHorizon, IsTheDefinitionOnEvery3x3TerrainOfTwoHeights) {
  ExpectTheDefinitionOnEvery(3, 3, 2);
}

TEST(FindHorizon, IsTheDefinitionOnEvery2x2And2x3TerrainOfThreeHeights) {
  ExpectTheDefinitionOnEvery(2, 2, 3);
  ExpectTheDefinitionOnEvery(2, 3, 3);
  ExpectTheDefinitionOnEvery(3, 2, 3);
}

// 19,683 and 4,096 terrains.
TEST(FindHorizonLong, IsTheDefinitionOnEvery3x3TerrainOfThreeHeightsAnd4x3OfTwo) {
  ExpectTheDefinitionOnEvery(3, 3, 3);
  ExpectTheDefinitionOnEvery(4, 3, 2);
}

TEST(FindHorizonLong, IsTheDefinitionOnTensOfThousandsOfRandomTerrains) {
  ExpectTheDefinitionOnRandomTerrains(2, 5, Rounds(40'000), 101);
  ExpectTheDefinitionOnRandomTerrains(4, 8, Rounds(5'000), 102);
  ExpectTheDefinitionOnRandomTerrains(9, 14, Rounds(200), 103);
}

TEST(FindHorizon, IsTheDefinitionOnSmallRandomTerrains) {
  ExpectTheDefinitionOnRandomTerrains(3, 5, Rounds(4'000), 1);
}

TEST(FindHorizon, IsTheDefinitionOnRandomTerrainsOfUpToSevenPosts) {
  ExpectTheDefinitionOnRandomTerrains(5, 7, Rounds(600), 2);
}

TEST(FindHorizon, IsTheDefinitionOnNarrowTerrains) {
  std::mt19937 random(3);
  for (int round = 0; round < Rounds(500); ++round) {
    const std::int32_t length = 2 + round % 12;
    const bool tall = round % 2 == 0;
    const RandomTerrain kind{.columns = tall ? 2 : length,
                             .rows = tall ? length : 2,
                             .max_height = round % 3 == 0 ? 1000 : 3,
                             .hole_percent = round % 5 == 0 ? 10 : 0};
    ASSERT_TRUE(MatchesBruteForce(RandomDem(kind, random), FindEdges)) << "round " << round;
  }
}

TEST(FindHorizon, IsTheDefinitionOnGreatHeightsAndCliffs) {
  constexpr std::int32_t kLimit = (1 << 30) - 1;
  constexpr std::int32_t kCliff = 1 << 25;
  std::mt19937 random(4);
  for (int round = 0; round < Rounds(300); ++round) {
    const std::int32_t n = 3 + round % 3;
    const Dem dem = MakeDem(n, n, [&](std::int32_t, std::int32_t) {
      // All over the range; or cliffs whose tops and feet are quanta apart: the narrowest gaps.
      if (round % 2 == 0) return static_cast<std::int32_t>(random() >> 1U) - kLimit;
      const std::int32_t end = random() % 2 == 0 ? 0 : kCliff;
      return end + static_cast<std::int32_t>(random() % 3);
    });
    ASSERT_TRUE(MatchesBruteForce(dem, FindEdges)) << "round " << round;
    const Terrain terrain = *Terrain::Build(dem);
    ASSERT_TRUE(EveryWitnessHolds(terrain, HorizonOf(terrain))) << DrawAscii(dem);
  }
}

TEST(FindHorizon, IsTheDefinitionOnFractalTerrains) {
  for (std::uint32_t seed = 1; seed <= static_cast<std::uint32_t>(Rounds(12)); ++seed) {
    const int roughness = seed % 3 == 0 ? 60 : (seed % 3 == 1 ? 100 : 140);
    const std::int32_t relief = seed % 2 == 0 ? 20 : 3000;
    ASSERT_TRUE(MatchesBruteForce(FractalDem(17, relief, roughness, seed), FindEdges)) << seed;
  }
}

TEST(FindHorizon, GivesAWitnessThatHoldsForEveryEdge) {
  std::mt19937 random(5);
  for (int round = 0; round < Rounds(1'500); ++round) {
    const Dem dem = AnyRandomDem(2, 8, random);
    Result<Terrain> terrain = Terrain::Build(dem);
    if (!terrain) continue;
    ASSERT_TRUE(EveryWitnessHolds(*terrain, HorizonOf(*terrain))) << DrawAscii(dem);
  }
  const Dem dem = FractalDem(33, 2000, 100, 5);
  const Terrain terrain = *Terrain::Build(dem);
  EXPECT_TRUE(EveryWitnessHolds(terrain, HorizonOf(terrain)));
}

TEST(FindHorizon, LeavesOutNoEdgeThatARandomLineFindsOnFractalTerrains) {
  for (const int roughness : {50, 100, 140}) {
    const Dem dem = FractalDem(65, 4000, roughness, static_cast<std::uint32_t>(roughness));
    const Terrain terrain = *Terrain::Build(dem);
    EXPECT_TRUE(MaximiserIsIn(terrain, FindEdges(terrain), Rounds(2'000), 6)) << roughness;
  }
}

TEST(FindHorizon, LeavesOutNoEdgeThatARandomLineFindsOnWhiteNoise) {
  std::mt19937 random(7);
  const Dem dem = RandomDem({.columns = 65, .rows = 65, .max_height = 1000}, random);
  const Terrain terrain = *Terrain::Build(dem);
  EXPECT_TRUE(MaximiserIsIn(terrain, FindEdges(terrain), Rounds(2'000), 7));
}

TEST(FindHorizon, IsTheSameForAnyNumberOfThreads) {
  for (const Dem& dem : {FractalDem(97, 3000, 100, 10), Paraboloid(33, -1)}) {
    const Terrain terrain = *Terrain::Build(dem);
    const Horizon one = HorizonOf(terrain, 1);
    for (const int threads : {2, 4, 7}) {
      const Horizon many = HorizonOf(terrain, threads);
      ASSERT_EQ(EdgesFound(many), EdgesFound(one));
      for (std::size_t i = 0; i < one.edges.size(); ++i) {
        ASSERT_EQ(many.edges[i].witness.t, one.edges[i].witness.t);
        ASSERT_EQ(many.edges[i].witness.dc, one.edges[i].witness.dc);
        ASSERT_EQ(many.edges[i].witness.dr, one.edges[i].witness.dr);
      }
      EXPECT_EQ(many.statistics.candidates, one.statistics.candidates);
      EXPECT_EQ(many.statistics.predicates.filtered, one.statistics.predicates.filtered);
      EXPECT_EQ(many.statistics.predicates.exact, one.statistics.predicates.exact);
      EXPECT_EQ(many.statistics.predicates.tied, one.statistics.predicates.tied);
    }
  }
}

TEST(FindHorizon, CountsTheEdgesOfTheTerrainAndNoMoreCandidates) {
  const Dem dem = FractalDem(33, 900, 100, 11);
  const Terrain terrain = *Terrain::Build(dem);
  const Horizon horizon = HorizonOf(terrain);
  EXPECT_EQ(horizon.statistics.terrain_edges, terrain.CountEdges());
  EXPECT_LE(static_cast<std::int64_t>(horizon.edges.size()), horizon.statistics.candidates);
  EXPECT_LE(horizon.statistics.candidates, horizon.statistics.terrain_edges);
  EXPECT_GE(horizon.statistics.peaks, horizon.statistics.births);
}

TEST(FindHorizon, StopsWhenAskedTo) {
  const Dem dem = FractalDem(65, 900, 100, 12);
  std::stop_source source;
  source.request_stop();
  Result<Horizon> horizon = FindHorizon(*Terrain::Build(dem), {}, {.stop = source.get_token()});
  ASSERT_FALSE(horizon);
  EXPECT_EQ(horizon.error().code, ErrorCode::kCancelled);
}

Dem WhiteNoise(std::int32_t side, std::uint32_t seed) {
  std::mt19937 random(seed);
  return RandomDem({.columns = side, .rows = side, .max_height = 1'000'000}, random);
}

TEST(FindHorizon, EndsWithAnErrorWhereTheWorkBudgetDoesNotSuffice) {
  const Dem dem = WhiteNoise(33, 15);
  const Terrain terrain = *Terrain::Build(dem);
  WorkBudget any(WorkBudget::kMost);
  const Horizon whole = *FindHorizon(terrain, {}, any, {});
  const std::int64_t needed = any.spent();
  EXPECT_GT(needed, whole.statistics.predicates.Sum()) << "candidates count, too";
  for (const int threads : {1, 3}) {
    Result<Horizon> enough = FindHorizon(terrain, {.threads = threads, .work_budget = needed}, {});
    ASSERT_TRUE(enough) << enough.error().message;
    EXPECT_EQ(EdgesFound(*enough), EdgesFound(whole));
    EXPECT_EQ(enough->statistics.undecided, 0);
    Result<Horizon> scarce =
        FindHorizon(terrain, {.threads = threads, .work_budget = needed - 1}, {});
    ASSERT_FALSE(scarce) << "the sum over all threads is what counts";
    EXPECT_EQ(scarce.error().code, ErrorCode::kResourceExhausted);
    EXPECT_EQ(scarce.error().kind, "work-budget");
    EXPECT_THAT(scarce.error().message, testing::HasSubstr(std::to_string(needed - 1)));
    EXPECT_THAT(scarce.error().message, testing::HasSubstr("approximate"));
  }
}

TEST(FindHorizon, KeepsAMarkedSupersetWhereItMayBeApproximate) {
  const Dem dem = WhiteNoise(33, 16);
  const Terrain terrain = *Terrain::Build(dem);
  const Horizon exact = HorizonOf(terrain);
  // With less work on candidates, too, more of the terrain's edges are left to be decided.
  std::int64_t least_undecided = exact.statistics.terrain_edges;
  std::int64_t candidates = 0;
  for (const std::int64_t divisor : {1000, 30, 2}) {
    const std::int64_t budget = exact.statistics.predicates.Sum() / divisor;
    Result<Horizon> some = FindHorizon(terrain, {.work_budget = budget, .approximate = true}, {});
    ASSERT_TRUE(some);
    const std::vector<Edge> kept = EdgesFound(*some);
    const std::vector<Edge> wanted = EdgesFound(exact);
    EXPECT_TRUE(std::includes(kept.begin(), kept.end(), wanted.begin(), wanted.end()));
    std::int64_t undecided = 0;
    for (const HorizonEdge& e : some->edges) {
      undecided += e.undecided ? 1 : 0;
      if (e.undecided) continue;
      EXPECT_TRUE(std::binary_search(wanted.begin(), wanted.end(), e.edge));
      EXPECT_TRUE(WitnessHolds(terrain, e.edge, e.witness));
    }
    EXPECT_GT(undecided, 0);
    EXPECT_EQ(undecided, some->statistics.undecided);
    EXPECT_LE(undecided, least_undecided) << "more work, fewer undecided edges";
    least_undecided = undecided;
    candidates = some->statistics.candidates;
  }
  EXPECT_LT(4 * least_undecided, 3 * candidates);
}

TEST(FindHorizon, IsApproximateInTheSameWayForAnyNumberOfThreads) {
  const Dem dem = WhiteNoise(49, 17);
  const Terrain terrain = *Terrain::Build(dem);
  const auto find = [&terrain](int threads) {
    return *FindHorizon(terrain, {.threads = threads, .work_budget = 500'000, .approximate = true},
                        {});
  };
  const Horizon one = find(1);
  ASSERT_GT(one.statistics.undecided, 0);
  for (const int threads : {2, 5}) {
    const Horizon many = find(threads);
    ASSERT_EQ(many.edges.size(), one.edges.size());
    EXPECT_EQ(many.statistics.predicates.Sum(), one.statistics.predicates.Sum());
    for (std::size_t i = 0; i < one.edges.size(); ++i) {
      ASSERT_EQ(many.edges[i].edge, one.edges[i].edge);
      ASSERT_EQ(many.edges[i].undecided, one.edges[i].undecided);
      ASSERT_EQ(many.edges[i].witness.t, one.edges[i].witness.t);
      ASSERT_EQ(many.edges[i].witness.dc, one.edges[i].witness.dc);
      ASSERT_EQ(many.edges[i].witness.dr, one.edges[i].witness.dr);
    }
  }
}

TEST(FindHorizon, IsNoLessExactForBeingAllowedToApproximate) {
  const Dem dem = FractalDem(65, 3000, 100, 18);
  const Terrain terrain = *Terrain::Build(dem);
  const Horizon plain = HorizonOf(terrain);
  const Horizon allowed = *FindHorizon(terrain, {.approximate = true}, {});
  ASSERT_EQ(EdgesFound(allowed), EdgesFound(plain));
  EXPECT_EQ(allowed.statistics.undecided, 0);
  for (std::size_t i = 0; i < plain.edges.size(); ++i) {
    ASSERT_EQ(allowed.edges[i].witness.t, plain.edges[i].witness.t);
  }
}

TEST(WitnessHolds, IsTheDefinitionOnRandomLines) {
  std::mt19937 random(13);
  int held = 0;
  int denied = 0;
  for (int round = 0; round < Rounds(2'000); ++round) {
    const Dem dem = AnyRandomDem(2, 6, random);
    Result<Terrain> terrain = Terrain::Build(dem);
    if (!terrain) continue;
    const std::vector<Edge> edges = terrain->Edges();
    const std::vector<Segment> all = SegmentsOf(*terrain, edges);
    for (int shot = 0; shot < 10; ++shot) {
      const std::size_t i = random() % edges.size();
      const Witness witness{static_cast<double>(1 + random() % 15) / 16,
                            static_cast<std::int32_t>(random() % 9) - 4,
                            static_cast<std::int32_t>(random() % 9) - 4};
      const Segment& e = all[i];
      if ((e.b.x - e.a.x) * witness.dr == (e.b.y - e.a.y) * witness.dc) continue;  // along the edge
      const bool expected =
          static_cast<bool>(LineOfSightIsClear(witness, all[i], all, Ties::kPass));
      ASSERT_EQ(WitnessHolds(*terrain, edges[i], witness), expected)
          << DrawAscii(dem) << "edge " << edges[i].a << '-' << edges[i].b << " t " << witness.t
          << " direction " << witness.dc << ' ' << witness.dr;
      ++(expected ? held : denied);
    }
  }
  EXPECT_GT(held, Rounds(1'000));
  EXPECT_GT(denied, Rounds(1'000));
}

// Where the tree says that a segment is occluded, no line across it passes over the terrain without
// meeting ground at or above its height.
TEST(HullMergeTree, OccludesOnlyWhatIsOnNoLineOfSight) {
  std::mt19937 random(14);
  int occluded = 0;
  for (int round = 0; round < Rounds(1'000); ++round) {
    const Dem dem = AnyRandomDem(3, 7, random);
    Result<Terrain> terrain = Terrain::Build(dem);
    if (!terrain) continue;
    const Horizon horizon = HorizonOf(*terrain);
    const std::vector<Segment> ground = SegmentsOf(*terrain, terrain->Edges());
    for (int shot = 0; shot < 10; ++shot) {
      const auto u = static_cast<VertexId>(random() % dem.heights.size());
      const auto w = static_cast<VertexId>(random() % dem.heights.size());
      if (u == w || !terrain->IsVertex(u) || !terrain->IsVertex(w)) continue;
      Segment segment{terrain->Point(u), terrain->Point(w)};
      const std::int32_t height =
          std::max(segment.a.z, segment.b.z) - static_cast<std::int32_t>(random() % 3);
      segment.a.z = height;
      segment.b.z = height;
      if (!horizon.hulls.Occludes(u, w, height)) continue;
      ++occluded;
      ASSERT_FALSE(LineOfSightByBruteForce(segment, ground, Ties::kBlock))
          << DrawAscii(dem) << DrawSegments({segment});
    }
  }
  EXPECT_GT(occluded, Rounds(100));
}

}  // namespace
}  // namespace farhorizon

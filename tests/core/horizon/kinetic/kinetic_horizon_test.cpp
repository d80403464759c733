// The kinetic engine against the definition, and against the adaptive engine where the brute force
// is too slow. Runs the whole engine; the scene by itself is in neighbour_scene_test.cpp.
#include "core/horizon/kinetic/kinetic_horizon.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/horizon/find_horizon.h"
#include "core/io/dem/read_dem.h"
#include "tests/support/ascii_dem.h"
#include "tests/support/effort.h"
#include "tests/support/matchers.h"
#include "tests/support/terrains.h"

namespace farhorizon {
namespace {

std::vector<Edge> FindKinetically(const Terrain& terrain) {
  return (*FindHorizonKinetic(terrain, {})).edges;
}

std::vector<Edge> FindAdaptively(const Terrain& terrain) {
  std::vector<Edge> edges;
  const Horizon horizon = *FindHorizon(terrain, {}, {});
  for (const HorizonEdge& e : horizon.edges) edges.push_back(e.edge);
  return edges;
}

/// The n-th DEM of columns x rows posts with heights 0 ... levels - 1.
Dem NthDem(std::int32_t columns, std::int32_t rows, std::int32_t levels, std::int32_t n) {
  return MakeDem(columns, rows, [&](std::int32_t, std::int32_t) {
    const std::int32_t height = n % levels;
    n /= levels;
    return height;
  });
}

void ExpectTheDefinitionOnEvery(std::int32_t columns, std::int32_t rows, std::int32_t levels,
                                std::int32_t step) {
  std::int32_t count = 1;
  for (std::int32_t i = 0; i < columns * rows; ++i) count *= levels;
  for (std::int32_t n = 0; n < count; n += step) {
    ASSERT_TRUE(MatchesBruteForce(NthDem(columns, rows, levels, n), FindKinetically))
        << "number " << n;
  }
}

void ExpectTheDefinitionOnRandomTerrains(std::int32_t min_side, std::int32_t max_side, int rounds,
                                         std::uint32_t seed) {
  std::mt19937 random(seed);
  for (int round = 0; round < rounds; ++round) {
    ASSERT_TRUE(MatchesBruteForce(AnyRandomDem(min_side, max_side, random), FindKinetically))
        << "round " << round;
  }
}

void ExpectTheAdaptiveAnswer(const Dem& dem) {
  Result<Terrain> terrain = Terrain::Build(dem);
  if (!terrain) return;
  EXPECT_EQ(FindKinetically(*terrain), FindAdaptively(*terrain));
}

/// The posts of `dem` in the middle, side x side at most.
Dem Middle(const Dem& dem, std::int32_t side) {
  const std::int32_t columns = std::min(side, dem.columns);
  const std::int32_t rows = std::min(side, dem.rows);
  return MakeDem(columns, rows, [&](std::int32_t c, std::int32_t r) {
    const std::int32_t column = c + (dem.columns - columns) / 2;
    const std::int32_t row = r + (dem.rows - rows) / 2;
    return dem.heights[static_cast<std::size_t>(std::int64_t{row} * dem.columns + column)];
  });
}

void ExpectTheAdaptiveAnswerOn(const std::string& name, std::int32_t side) {
  const std::filesystem::path path = std::filesystem::path(FARHORIZON_DEM_DIR) / name;
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no " << name << " in FARHORIZON_DEM_DIR";
  Result<Dem> dem = ReadDem(path, {});
  ASSERT_TRUE(dem) << dem.error().message;
  ExpectTheAdaptiveAnswer(Middle(*dem, side));
}

TEST(FindHorizonKinetic, FindsTheKnownHorizonsOfTheNamedTerrains) {
  for (const NamedTerrain& named : NamedTerrains()) {
    EXPECT_TRUE(MatchesBruteForce(named.dem, FindKinetically)) << named.name;
    if (named.horizon_edges < 0) continue;
    EXPECT_EQ(static_cast<int>(FindKinetically(*Terrain::Build(named.dem)).size()),
              named.horizon_edges)
        << named.name;
  }
}

TEST(FindHorizonKinetic, FindsEveryAxisEdgeOfALargeDome) {
  const Dem dem = Paraboloid(65, -1);
  EXPECT_EQ(FindKinetically(*Terrain::Build(dem)).size(), 8320U);
}

TEST(FindHorizonKinetic, HoldsToTheDefinitionOnASampleOfAllTerrainsOfThreeByThreePosts) {
  ExpectTheDefinitionOnEvery(3, 3, 3, 7);
}

TEST(FindHorizonKinetic, HoldsToTheDefinitionOnSmallRandomTerrains) {
  ExpectTheDefinitionOnRandomTerrains(3, 6, Rounds(1000), 1);
}

TEST(FindHorizonKinetic, HoldsToTheDefinitionOnRandomTerrains) {
  ExpectTheDefinitionOnRandomTerrains(6, 9, Rounds(100), 2);
}

// Found by the first comparisons: two hulls that come into contact at the level edge's own height
// leave lines that part them through the contact alone, which are no open set.
TEST(FindHorizonKinetic, DoesNotSeeLevelEdgesThroughAContactOfTwoHulls) {
  EXPECT_TRUE(MatchesBruteForce(AsciiDem(R"(
      . 1
      0 0
      1 0)"),
                                FindKinetically));
  EXPECT_TRUE(MatchesBruteForce(AsciiDem(R"(
      1 0 1
      . 0 0)"),
                                FindKinetically));
}

/// Every way to keep tangents and hulls.
std::vector<KineticOptions> AllOptions() {
  return {{},
          {.hull = HullCertificates::kTree},
          {.tangents = KineticTangents::kAllPairs},
          {.tangents = KineticTangents::kAllPairs, .hull = HullCertificates::kTree}};
}

// Throws where an invariant of the scene does not hold.
void CheckOnRandomTerrains(std::int32_t min_side, std::int32_t max_side, int rounds,
                           std::uint32_t seed) {
  std::mt19937 random(seed);
  for (int round = 0; round < rounds; ++round) {
    const Dem dem = AnyRandomDem(min_side, max_side, random);
    Result<Terrain> terrain = Terrain::Build(dem);
    if (!terrain) continue;
    SCOPED_TRACE(DrawAscii(dem));
    for (const KineticOptions& options : AllOptions()) {
      ASSERT_NO_THROW({
        EXPECT_EQ(FindHorizonKineticChecked(*terrain, options)->edges, FindKinetically(*terrain));
      });
    }
  }
}

TEST(FindHorizonKinetic, KeepsItsInvariantsOnRandomTerrains) {
  CheckOnRandomTerrains(3, 9, Rounds(150), 28);
  CheckOnRandomTerrains(11, 13, Rounds(3), 29);
}

TEST(FindHorizonKineticLong, KeepsItsInvariantsOnRandomTerrains) {
  CheckOnRandomTerrains(3, 9, Rounds(4000), 30);
  CheckOnRandomTerrains(15, 25, Rounds(12), 31);
}

// A hull that ended at a corner joins one that hides the corner throughout: as many hide its first
// edge as before, and what was seen beyond the end is not seen any more.
TEST(FindHorizonKinetic, KeepsItsInvariantsWhereAJoinedHullHidesNoMoreOfAnEdgeButMoreOfACorner) {
  const Dem dem = AsciiDem(R"(
      . 1 . 2 0 2
      . 0 1 1 . 0
      . 0 . 0 1 .
      2 2 1 . 0 1)");
  for (const KineticOptions& options : AllOptions()) {
    EXPECT_NO_THROW({ EXPECT_TRUE(FindHorizonKineticChecked(*Terrain::Build(dem), options)); });
  }
}

TEST(FindHorizonKinetic, AgreesWithTheAdaptiveEngineOnLargerRandomTerrains) {
  std::mt19937 random(3);
  for (int round = 0; round < Rounds(20); ++round) {
    SCOPED_TRACE(round);
    ExpectTheAdaptiveAnswer(AnyRandomDem(17, 33, random));
  }
}

TEST(FindHorizonKinetic, AgreesWithTheAdaptiveEngineOnMountains) {
  for (const std::int32_t relief : {5, 100, 3000, 1 << 20, 1 << 26}) {
    for (const int roughness : {60, 100, 150}) {
      SCOPED_TRACE(std::to_string(relief) + " " + std::to_string(roughness));
      ExpectTheAdaptiveAnswer(FractalDem(33, relief, roughness, 7));
    }
  }
  ExpectTheAdaptiveAnswer(FractalDem(65, 3000, 100, 8));
}

TEST(FindHorizonKinetic, CountsTheEventsOfTwoSummits) {
  const Dem dem = AsciiDem(R"(
      0 1 2 3 4
      1 9 3 8 3
      2 3 2 3 2
      0 1 0 2 0)");
  const Terrain terrain = *Terrain::Build(dem);
  const KineticOptions options{.tangents = KineticTangents::kAllPairs};
  const EventCounts events = (*FindHorizonKinetic(terrain, {}, options)).events;
  EXPECT_EQ(events.peak + events.regular + events.saddle + events.minimum, 20);
  EXPECT_EQ(events.clusters_max, events.peak);
  EXPECT_EQ(events.merge, events.peak - 1) << "in the end all is one hull";
  EXPECT_EQ(events.by_kind[0] + events.by_kind[1] + events.by_kind[2] + events.by_kind[3],
            events.Bitangents());
  EXPECT_GT(events.queue_max, 0);
}

// The tree certifies all points, so it has events at which no corner changes; those at which one
// does are the same.
TEST(FindHorizonKinetic, CountsTheEventsOfTheTreeBesideThoseOfTheTurns) {
  const Dem dem = FractalDem(33, 3000, 100, 8);
  const Terrain terrain = *Terrain::Build(dem);
  const EventCounts turns = FindHorizonKinetic(terrain, {})->events;
  const EventCounts tree =
      FindHorizonKinetic(terrain, {}, {.hull = HullCertificates::kTree})->events;
  EXPECT_GT(turns.inside, 0);
  EXPECT_EQ(tree.inside, 0) << "no point has a triangle";
  EXPECT_GT(tree.hull, turns.hull);
  EXPECT_EQ(std::accumulate(tree.tree.begin(), tree.tree.end(), std::int64_t{0}), tree.hull);
  for (const std::int64_t of_kind : tree.tree) EXPECT_GT(of_kind, 0);
  EXPECT_EQ(std::accumulate(turns.tree.begin(), turns.tree.end(), std::int64_t{0}), 0);
  EXPECT_EQ(tree.merge, turns.merge);
  EXPECT_EQ(tree.clusters_max, turns.clusters_max);
}

TEST(FindHorizon, GivesTheKineticEnginesEdgesWitnessesThatHold) {
  std::mt19937 random(9);
  for (int round = 0; round < Rounds(50); ++round) {
    const Dem dem = AnyRandomDem(3, 12, random);
    Result<Terrain> terrain = Terrain::Build(dem);
    if (!terrain) continue;
    const Horizon horizon = *FindHorizon(*terrain, {.engine = Engine::kKinetic}, {});
    std::vector<Edge> edges;
    for (const HorizonEdge& e : horizon.edges) {
      EXPECT_TRUE(WitnessHolds(*terrain, e.edge, e.witness));
      edges.push_back(e.edge);
    }
    EXPECT_EQ(edges, FindAdaptively(*terrain));
    EXPECT_GT(horizon.statistics.queue_max, 0);
  }
}

TEST(FindHorizonKinetic, SaysThatHeightsAreTooLarge) {
  const Dem dem = MakeDem(32768, 2, [](std::int32_t c, std::int32_t) {
    return c == 0 ? (1 << 30) - 1 : -(1 << 30) + 1;
  });
  const Terrain terrain = *Terrain::Build(dem);
  Result<KineticHorizon> horizon = FindHorizonKinetic(terrain, {});
  ASSERT_FALSE(horizon);
  EXPECT_EQ(horizon.error().kind, "kinetic-too-large");
}

TEST(FindHorizonKinetic, EndsWithAnErrorWhereTheWorkBudgetDoesNotSuffice) {
  const Dem dem = FractalDem(33, 3000, 100, 8);
  const Terrain terrain = *Terrain::Build(dem);
  const KineticHorizon whole = *FindHorizonKinetic(terrain, {});
  Result<KineticHorizon> enough =
      FindHorizonKinetic(terrain, {}, {.work_budget = whole.events.work});
  ASSERT_TRUE(enough) << enough.error().message;
  EXPECT_EQ(enough->edges, whole.edges);
  Result<KineticHorizon> scarce =
      FindHorizonKinetic(terrain, {}, {.work_budget = whole.events.work - 1});
  ASSERT_FALSE(scarce);
  EXPECT_EQ(scarce.error().code, ErrorCode::kResourceExhausted);
  EXPECT_EQ(scarce.error().kind, "work-budget");
  const HorizonOptions options{.engine = Engine::kKinetic, .work_budget = 10, .approximate = true};
  Result<Horizon> chosen = FindHorizon(terrain, options, {});
  ASSERT_FALSE(chosen) << "its budget leaves no superset behind: the adaptive engine's does";
  EXPECT_EQ(chosen.error().kind, "work-budget");
  EXPECT_NE(chosen.error().message.find("take the adaptive engine"), std::string::npos);
}

Dem Spikes(std::int32_t side) {
  return MakeDem(side, side, [side](std::int32_t c, std::int32_t r) {
    return c % 3 == 1 && r % 3 == 1 ? 1'000'000 + c + side * r : 0;
  });
}

// Each spike is a hull of its own until the plane is down.
TEST(FindHorizonKinetic, KeepsTheTangentsOfNeighboursOnly) {
  const Dem dem = Spikes(33);
  const KineticHorizon horizon = *FindHorizonKinetic(*Terrain::Build(dem), {});
  EXPECT_EQ(horizon.events.clusters_max, 121);
  EXPECT_LT(horizon.events.tangents_max, 4 * 121) << "of 7,260 pairs";
}

TEST(FindHorizonKineticLong, DealsWithMoreThanAThousandHulls) {
  const Dem dem = Spikes(105);
  const Terrain terrain = *Terrain::Build(dem);
  const KineticHorizon horizon = *FindHorizonKinetic(terrain, {});
  EXPECT_EQ(horizon.events.clusters_max, 35 * 35);
  EXPECT_LT(horizon.events.tangents_max, 4 * 35 * 35);
}

TEST(FindHorizonKinetic, StopsWhenAskedTo) {
  const Dem dem = FractalDem(33, 3000, 100, 8);
  const Terrain terrain = *Terrain::Build(dem);
  std::stop_source source;
  source.request_stop();
  Result<KineticHorizon> horizon = FindHorizonKinetic(terrain, {.stop = source.get_token()});
  ASSERT_FALSE(horizon);
  EXPECT_EQ(horizon.error().code, ErrorCode::kCancelled);
}

class FindHorizonKineticOnDem : public testing::TestWithParam<const char*> {};
TEST_P(FindHorizonKineticOnDem, AgreesWithTheAdaptiveEngine) {
  ExpectTheAdaptiveAnswerOn(GetParam(), 65);
}
INSTANTIATE_TEST_SUITE_P(Small, FindHorizonKineticOnDem,
                         testing::Values("gabilan_65.tif", "ontario_dted0_121.tif",
                                         "sthelens_crater_129.tif", "zion_257.tif",
                                         "capetown_srtm3_nodata_sea.tif",
                                         "fortworth_srtm3_rolling.tif"));

TEST(FindHorizonKineticLong, HoldsToTheDefinitionOnAllTerrainsOfThreeByThreePosts) {
  ExpectTheDefinitionOnEvery(3, 3, 3, 1);
}

TEST(FindHorizonKineticLong, HoldsToTheDefinitionOnManyRandomTerrains) {
  ExpectTheDefinitionOnRandomTerrains(3, 9, Rounds(5000), 5);
}

}  // namespace
}  // namespace farhorizon

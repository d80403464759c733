// Cliffs of thousands to 2^31 quanta whose tops and feet differ by single quanta: lines of sight
// pass through very narrow gaps. The set of edges is the definition's at any height; witnesses are
// exact as long as doubles can represent them.
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "core/horizon/candidate_decider.h"
#include "core/horizon/find_horizon.h"
#include "core/horizon/sweep/candidates.h"
#include "tests/oracles/horizon_brute_force.h"
#include "tests/support/ascii_dem.h"
#include "tests/support/effort.h"
#include "tests/support/matchers.h"
#include "tests/support/terrains.h"

namespace farhorizon {
namespace {

// Heights of the feet and tops of cliffs. Each post is at one of them, or up to 3 quanta above.
using CliffHeights = std::vector<std::int32_t>;

constexpr std::int32_t kTop = (1 << 30) - 4;

Dem CliffDem(std::int32_t columns, std::int32_t rows, const CliffHeights& heights,
             std::mt19937& random) {
  return MakeDem(columns, rows, [&](std::int32_t, std::int32_t) {
    return heights[random() % heights.size()] + static_cast<std::int32_t>(random() % 4);
  });
}

// What FindHorizon decides, whether or not all witnesses are exact.
Horizon DecideAll(const Terrain& terrain) {
  WorkBudget any(WorkBudget::kMost);
  const Candidates candidates = *FindCandidates(terrain, *SweepHulls(terrain, 1, {}), 1, any, {});
  CandidateDecider decider(terrain, candidates);
  EXPECT_TRUE(decider.Decide({}, any, {}));
  Horizon horizon;
  decider.AppendEdges(horizon);
  return horizon;
}

std::vector<Edge> FindEvenInexact(const Terrain& terrain) {
  std::vector<Edge> edges;
  const Horizon horizon = DecideAll(terrain);
  for (const HorizonEdge& e : horizon.edges) edges.push_back(e.edge);
  return edges;
}

struct Tally {
  int exact = 0;            // witnesses
  int inexact = 0;          // edges whose witness cannot be represented
  int long_directions = 0;  // of 2^53 and more
};

// The set of edges is the definition's, every exact witness holds by two checks, and FindHorizon
// returns all edges and warns of those whose witness is not exact.
void ExpectTheDefinition(const Dem& dem, Tally& tally) {
  ASSERT_TRUE(MatchesBruteForce(dem, FindEvenInexact));
  const Terrain terrain = *Terrain::Build(dem);
  const std::vector<Segment> all = SegmentsOf(terrain, terrain.Edges());
  int inexact = 0;
  const Horizon decided = DecideAll(terrain);
  for (const HorizonEdge& s : decided.edges) {
    if (!s.witness.exact) {
      ++inexact;
      EXPECT_FALSE(WitnessHolds(terrain, s.edge, s.witness));
      continue;
    }
    ++tally.exact;
    constexpr std::int64_t kLong = std::int64_t{1} << 53;
    if (std::max(std::abs(s.witness.dc), std::abs(s.witness.dr)) >= kLong) ++tally.long_directions;
    ASSERT_TRUE(WitnessHolds(terrain, s.edge, s.witness))
        << DrawAscii(dem) << "edge " << s.edge.a << '-' << s.edge.b;
    ASSERT_TRUE(LineOfSightIsClear(s.witness, SegmentsOf(terrain, {s.edge})[0], all, Ties::kPass))
        << DrawAscii(dem) << "edge " << s.edge.a << '-' << s.edge.b;
  }
  tally.inexact += inexact;
  std::string warning;
  RunControl control;
  control.on_warning = [&warning](const std::string& text) { warning += text; };
  const Horizon found = *FindHorizon(terrain, {}, control);
  ASSERT_EQ(found.edges.size(), decided.edges.size()) << DrawAscii(dem);
  EXPECT_EQ(warning.empty(), inexact == 0);
  if (inexact > 0) {
    EXPECT_EQ(warning.find(std::to_string(inexact) + " edges"), 0U) << warning;
  }
}

Tally ExpectTheDefinitionOn(const CliffHeights& heights, int rounds, std::uint32_t seed) {
  std::mt19937 random(seed);
  Tally tally;
  for (int round = 0; round < rounds && !testing::Test::HasFatalFailure(); ++round) {
    // 3 x 3 mostly, up to 6 x 6.
    const auto side = [&random] {
      return 3 + static_cast<std::int32_t>(std::min(random() % 4, random() % 4));
    };
    const std::int32_t columns = side();
    const std::int32_t rows = side();
    ExpectTheDefinition(CliffDem(columns, rows, heights, random), tally);
  }
  return tally;
}

TEST(GreatCliffs, AreTheDefinitionWhereTheyAreTenThousandsHigh) {
  Tally tally;
  ExpectTheDefinition(AsciiDem("    1     2 65533\n    0     2 65534\n65533     0     1"), tally);
  EXPECT_EQ(tally.inexact, 0);
  EXPECT_EQ(ExpectTheDefinitionOn({0, 65533}, Rounds(1'500), 1).inexact, 0);
}

TEST(GreatCliffs, HaveExactWitnessesUpTo67MillionQuanta) {
  for (const int bits : {18, 20, 22, 24, 26}) {
    const Tally tally =
        ExpectTheDefinitionOn({0, (1 << bits) - 4}, Rounds(300), static_cast<std::uint32_t>(bits));
    EXPECT_EQ(tally.inexact, 0) << bits;
  }
}

TEST(GreatCliffs, AreTheDefinitionWhereTheyAreHalfTheRangeHigh) {
  const Tally tally = ExpectTheDefinitionOn({0, (1 << 29) - 3}, Rounds(1'500), 2);
  EXPECT_GT(tally.exact, 100 * tally.inexact);
  EXPECT_GT(tally.inexact, 0);
}

TEST(GreatCliffs, AreTheDefinitionWhereTheyAreTheWholeRangeHigh) {
  ExpectTheDefinitionOn({-kTop - 3, kTop}, Rounds(1'500), 3);
}

TEST(GreatCliffs, AreTheDefinitionWhereTheyStandOnEachOther) {
  ExpectTheDefinitionOn({0, 1 << 15, 1 << 29}, Rounds(500), 4);
  ExpectTheDefinitionOn({-kTop - 3, 0, kTop}, Rounds(500), 5);
  ExpectTheDefinitionOn({0, 4, 1 << 10, 1 << 20, 1 << 28}, Rounds(500), 6);
}

TEST(GreatCliffsLong, AreTheDefinitionOnTensOfThousandsOfTerrains) {
  for (const int bits : {15, 16, 17, 19, 21, 23, 25, 26}) {
    const Tally tally = ExpectTheDefinitionOn({0, (1 << bits) - 4}, Rounds(5'000),
                                              static_cast<std::uint32_t>(100 + bits));
    EXPECT_EQ(tally.inexact, 0) << bits;
  }
  int inexact = 0;
  for (const int bits : {27, 28, 29, 30}) {
    inexact += ExpectTheDefinitionOn({-4, static_cast<std::int32_t>((1U << bits) - 4U)},
                                     Rounds(5'000), static_cast<std::uint32_t>(100 + bits))
                   .inexact;
  }
  EXPECT_GT(inexact, 0);
  ExpectTheDefinitionOn({-kTop - 3, kTop}, Rounds(10'000), 200);
  ExpectTheDefinitionOn({-kTop - 3, 0, 1 << 15, kTop}, Rounds(10'000), 201);
}

// Where the height of the viewpoint in doubles was that of a corner, or the viewpoint was on the
// corner, and the true one was not, the occluder of all other directions was skipped as occluded.
TEST(GreatCliffs, OnceLedToLinesThatMeetHigherGround) {
  Tally tally;
  ExpectTheDefinition(AsciiDem("134217725         0 134217725         1\n"
                               "134217727 134217726         2         2\n"
                               "134217727 134217727 134217724 134217725\n"
                               "        1         3         1         2"),
                      tally);
  ExpectTheDefinition(AsciiDem("134217725         0         2 134217724 134217725         0\n"
                               "134217726 134217726 134217724         2         2 134217725\n"
                               "        3         0         2 134217726 134217724 134217726\n"
                               "        0         2 134217725         1         3 134217727\n"
                               "        1 134217724 134217724 134217724         0 134217727\n"
                               "134217724         0 134217725 134217727         0         2"),
                      tally);
}

TEST(GreatCliffs, HaveAnEdgeWithoutWitnessWhereNoDoubleIsInTheGap) {
  const Dem dem = AsciiDem(
      "536870913         3     32770 536870912\n"
      "536870915     32770 536870915 536870912\n"
      "536870915 536870912         1     32768\n"
      "536870914         3         3     32771");
  const Terrain terrain = *Terrain::Build(dem);
  const Horizon horizon = *FindHorizon(terrain, {.threads = 2}, {});
  std::vector<VertexId> without;
  for (const HorizonEdge& e : horizon.edges) {
    if (!e.witness.exact) without.push_back(e.edge.a);
  }
  EXPECT_EQ(without, std::vector<VertexId>{2});
}

// The check decides every line that a double and 64-bit integers can represent.
TEST(WitnessHolds, IsTheDefinitionForTheFinestNumbers) {
  std::mt19937 random(7);
  std::mt19937_64 random64(7);
  int held = 0;
  int denied = 0;
  for (int round = 0; round < Rounds(1'500); ++round) {
    const CliffHeights heights =
        round % 2 == 0 ? CliffHeights{0, 4} : CliffHeights{-kTop - 3, kTop};
    const Dem dem = CliffDem(3, 3, heights, random);
    const Terrain terrain = *Terrain::Build(dem);
    const std::vector<Edge> edges = terrain.Edges();
    const std::vector<Segment> all = SegmentsOf(terrain, edges);
    for (int shot = 0; shot < 10; ++shot) {
      const std::size_t i = random() % edges.size();
      const auto any = [&random64] {
        const auto value = static_cast<std::int64_t>(random64() >> (2 + random64() % 60));
        return random64() % 2 == 0 ? value : -value;
      };
      const std::array<double, 4> positions = {
          std::ldexp(static_cast<double>(1 + random64() % 1000), -400),
          std::ldexp(static_cast<double>(1 + random64() % 1000), -200),
          1 - std::ldexp(static_cast<double>(1 + random64() % 1000), -53),
          std::ldexp(static_cast<double>(random64() >> 11U | 1U), -53)};
      const Witness witness{positions[random() % 4], any(), any()};
      if (witness.dc == 0 && witness.dr == 0) continue;
      const Segment& e = all[i];
      if (Int128{e.b.x - e.a.x} * witness.dr == Int128{e.b.y - e.a.y} * witness.dc) continue;
      const bool expected = static_cast<bool>(LineOfSightIsClear(witness, e, all, Ties::kPass));
      ASSERT_EQ(WitnessHolds(terrain, edges[i], witness), expected)
          << DrawAscii(dem) << "edge " << edges[i].a << '-' << edges[i].b << " t " << witness.t
          << " direction " << witness.dc << ' ' << witness.dr;
      ++(expected ? held : denied);
    }
  }
  EXPECT_GT(held, Rounds(500));
  EXPECT_GT(denied, Rounds(500));
}

// Beside the summit of a pyramid, the line is clear if it crosses the next ridge further down.
TEST(WitnessHolds, DecidesBesideAPostByTheLeastNumberThatADoubleHolds) {
  const Dem dem = AsciiDem(".0.\n010\n.0.");
  const Terrain terrain = *Terrain::Build(dem);
  constexpr double kLeast = 0x1p-1074;
  constexpr std::int64_t kLong = (std::int64_t{1} << 62) - 1;
  EXPECT_TRUE(WitnessHolds(terrain, {4, 5}, {kLeast, 0, 1}));
  EXPECT_TRUE(WitnessHolds(terrain, {4, 5}, {kLeast, kLong - 1, kLong}));
  EXPECT_FALSE(WitnessHolds(terrain, {4, 5}, {kLeast, kLong, kLong - 1}));
  EXPECT_FALSE(WitnessHolds(terrain, {4, 5}, {kLeast, 1000, 1}));
  EXPECT_FALSE(WitnessHolds(terrain, {4, 5}, {kLeast, 0, 1, false}));
  EXPECT_FALSE(WitnessHolds(terrain, {4, 5}, {kLeast, 0, kLong + 1}));
}

}  // namespace
}  // namespace farhorizon

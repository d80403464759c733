#include "tests/oracles/horizon_brute_force.h"

#include <algorithm>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/ascii_dem.h"
#include "tests/support/line_equation.h"
#include "tests/support/terrains.h"

namespace farhorizon {
namespace {

using oracle::FreeGap;
using oracle::Wide;

std::vector<Edge> HorizonOf(const Dem& dem) { return HorizonByBruteForce(*Terrain::Build(dem)); }

std::vector<Segment> SegmentsOfEdges(const OracleMesh& mesh, const std::vector<Edge>& edges) {
  std::vector<Segment> segments;
  for (const Edge e : edges) {
    segments.push_back(
        {mesh.points[static_cast<std::size_t>(e.a)], mesh.points[static_cast<std::size_t>(e.b)]});
  }
  return segments;
}

std::int64_t CountAt(const std::vector<Edge>& edges, VertexId post) {
  return std::count_if(edges.begin(), edges.end(),
                       [post](Edge e) { return e.a == post || e.b == post; });
}

/// The line of sight meets nothing of `obstacles` above the point it comes from (kPass), or at or
/// above it (kBlock), in one of some directions of its gap: an obstacle in line with the point
/// blocks one direction without an arc, so not every direction need do.
bool LineOfSightHolds(const OracleLineOfSight& sight, const Segment& segment,
                      const std::vector<Segment>& obstacles, Ties ties) {
  const Wide denominator = Wide(1) << static_cast<unsigned>(sight.t.exponent);
  const Ratio<Wide> own{
      segment.a.z * denominator + (Wide(segment.b.z) - segment.a.z) * sight.t.numerator,
      denominator};
  const FreeGap& gap = sight.gap;
  for (int from_weight = 1; from_weight <= 5; ++from_weight) {
    for (int to_weight = 1; to_weight <= 5; ++to_weight) {
      Wide dx = gap.from_x * from_weight + gap.to_x * to_weight;
      Wide dy = gap.from_y * from_weight + gap.to_y * to_weight;
      if (gap.from_y == 0 && gap.to_y == 0) {  // all directions are free
        dx = from_weight;
        dy = to_weight;
      }
      const LineEquation<Wide> line =
          LineThrough<Wide>(segment, sight.t.numerator, denominator, dx, dy);
      const bool free = std::none_of(obstacles.begin(), obstacles.end(), [&](const Segment& f) {
        const std::optional<Ratio<Wide>> height = HeightOver<Wide>(line, f);
        return height && (own < *height || (ties == Ties::kBlock && own == *height));
      });
      if (free) return true;
    }
  }
  return false;
}

/// Segments on a small grid, so that vertices, directions, heights and whole lines coincide often.
std::vector<Segment> RandomSegments(int count, std::int32_t side, std::int32_t max_height,
                                    std::mt19937& random) {
  const auto below = [&random](std::int32_t bound) {
    return static_cast<std::int32_t>(random() % static_cast<std::uint32_t>(bound));
  };
  std::vector<Segment> segments;
  while (static_cast<int>(segments.size()) < count) {
    const Segment s{{below(side), below(side), below(max_height + 1)},
                    {below(side), below(side), below(max_height + 1)}};
    if (s.a.x != s.b.x || s.a.y != s.b.y) segments.push_back(s);
  }
  return segments;
}

/// hor(S) for a set of segments: no crease rule, each against all others.
std::vector<Segment> Reduce(const std::vector<Segment>& segments) {
  std::vector<Segment> kept;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    std::vector<Segment> others = segments;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    if (LineOfSightByBruteForce(segments[i], others, Ties::kPass)) kept.push_back(segments[i]);
  }
  return kept;
}

std::vector<std::array<std::int32_t, 6>> SortedEdges(const std::vector<Segment>& segments) {
  std::vector<std::array<std::int32_t, 6>> rows;
  for (const Segment& s : segments) rows.push_back({s.a.x, s.a.y, s.a.z, s.b.x, s.b.y, s.b.z});
  std::sort(rows.begin(), rows.end());
  return rows;
}

// O1. A line that crosses a side of the square enters it, and leaves it or ends at a corner: on the
// way it crosses a slanted edge above the ground. So the sides are hidden, the slanted edges are
// not.
TEST(BruteForce, APyramidShowsItsFourSlantedEdges) {
  EXPECT_THAT(HorizonOf(AsciiDem(".0.\n010\n.0.")),
              testing::ElementsAre(Edge{1, 4}, Edge{3, 4}, Edge{4, 5}, Edge{4, 7}));
}

// O2 and O3: the peak of 8 inside the rim of 10 has the six edges of an inner post.
TEST(BruteForce, APeakInsideAClosedCraterIsHidden) {
  EXPECT_EQ(CountAt(HorizonOf(Crater(false, false, false)), 24), 0);
}

TEST(BruteForce, APeakInACraterOpenOnOneSideIsHidden) {
  EXPECT_EQ(CountAt(HorizonOf(Crater(true, false, false)), 24), 0);
}

TEST(BruteForce, APeakInACraterOpenToTwoSidesNotInLineIsHidden) {
  EXPECT_EQ(CountAt(HorizonOf(Crater(true, true, false)), 24), 0);
}

TEST(BruteForce, APeakInACraterOpenToOppositeSidesShowsFourOfItsSixEdges) {
  EXPECT_EQ(CountAt(HorizonOf(Crater(true, false, true)), 24), 4);
}

// O4. Rim, slopes, and the boundary edges at the north-east and the south-west corner: a line that
// cuts one of these corners off stays on its flat triangle, at height 0. At the other two corners
// it would cross the slanted edge that ends there. The plateau's diagonal 5-10 attains H too, but
// is no crease.
TEST(BruteForce, APlateauShowsItsRimItsSlopesAndTwoCornersOfTheMap) {
  EXPECT_THAT(
      HorizonOf(AsciiDem("0000\n0550\n0550\n0000")),
      testing::UnorderedElementsAre(Edge{5, 6}, Edge{5, 9}, Edge{6, 10}, Edge{9, 10},  // rim
                                    Edge{0, 5}, Edge{2, 6}, Edge{6, 7}, Edge{8, 9}, Edge{9, 13},
                                    Edge{10, 15},                                         // slopes
                                    Edge{2, 3}, Edge{3, 7}, Edge{8, 12}, Edge{12, 13}));  // corners
}

TEST(BruteForce, ABowlShowsItsSixteenBoundaryEdges) {
  const Dem dem = Paraboloid(5, 1);
  const std::vector<Edge> horizon = HorizonOf(dem);
  EXPECT_EQ(horizon.size(), 16U);
  for (const Edge e : horizon) {
    const bool along_row = dem.Row(e.a) == dem.Row(e.b) && dem.Row(e.a) % 4 == 0;
    const bool along_column = dem.Column(e.a) == dem.Column(e.b) && dem.Column(e.a) % 4 == 0;
    EXPECT_TRUE(along_row || along_column) << e.a << "-" << e.b;
  }
}

TEST(BruteForce, ADomeShowsEveryEdgeButTheDiagonals) {
  const Dem dem = Paraboloid(5, -1);
  const std::vector<Edge> horizon = HorizonOf(dem);
  EXPECT_EQ(horizon.size(), 40U);
  for (const Edge e : horizon) EXPECT_TRUE(e.b == e.a + 1 || e.b == e.a + 5) << e.a << "-" << e.b;
}

// O7. Six points; the two long sides are split along a diagonal that is no crease.
TEST(BruteForce, ARoofShowsItsRidgeAndItsFourHips) {
  const OracleMesh roof{{{0, 0, 0}, {6, 0, 0}, {6, 4, 0}, {0, 4, 0}, {2, 2, 3}, {4, 2, 3}},
                        {{0, 1, 5}, {0, 5, 4}, {2, 3, 4}, {2, 4, 5}, {3, 0, 4}, {1, 2, 5}}};
  EXPECT_THAT(HorizonByBruteForce(roof),
              testing::ElementsAre(Edge{0, 4}, Edge{1, 5}, Edge{2, 5}, Edge{3, 4}, Edge{4, 5}));
}

TEST(BruteForce, ShortCutsGiveTheAnswerOfAllCellsOnTerrains) {
  std::mt19937 random(1);
  for (int round = 0; round < 40; ++round) {
    const Dem dem = AnyRandomDem(3, 4, random);
    Result<Terrain> terrain = Terrain::Build(dem);
    if (!terrain) continue;
    const OracleMesh mesh = MeshOf(*terrain);
    std::vector<Edge> expected;
    const std::vector<Edge> creases = CreasesOf(mesh);
    for (const Edge e : creases) {
      std::vector<Edge> others = EdgesOf(mesh);
      std::erase(others, e);
      if (LineOfSightByAllCells(SegmentsOfEdges(mesh, {e})[0], SegmentsOfEdges(mesh, others),
                                Ties::kPass)) {
        expected.push_back(e);
      }
    }
    ASSERT_EQ(HorizonByBruteForce(mesh), expected) << DrawAscii(dem);
  }
}

TEST(BruteForce, ShortCutsGiveTheAnswerOfAllCellsOnSegmentsThatCrossAndOverlap) {
  std::mt19937 random(2);
  int seen = 0;
  constexpr int kRounds = 600;
  for (int round = 0; round < kRounds; ++round) {
    std::vector<Segment> segments = RandomSegments(4 + round % 14, 3 + round % 4, 3, random);
    const Segment segment = segments.back();
    segments.pop_back();
    for (const Ties ties : {Ties::kPass, Ties::kBlock}) {
      const std::optional<OracleLineOfSight> sight =
          LineOfSightByBruteForce(segment, segments, ties);
      ASSERT_EQ(sight.has_value(), LineOfSightByAllCells(segment, segments, ties))
          << "round " << round;
      if (sight) {
        ++seen;
        ASSERT_TRUE(LineOfSightHolds(*sight, segment, segments, ties)) << "round " << round;
      }
    }
  }
  EXPECT_GT(seen, kRounds / 4);
  EXPECT_LT(seen, kRounds * 2 * 9 / 10);
}

// A line through a point of the segment that meets everything else strictly below, and no end of
// anything, may be moved a little: whatever the oracle calls hidden has no such line.
TEST(BruteForce, NoRandomLineSeesASegmentThatIsHidden) {
  std::mt19937 random(3);
  int lines = 0;
  for (int round = 0; round < 400; ++round) {
    std::vector<Segment> segments = RandomSegments(8 + round % 9, 4, 4, random);
    const Segment segment = segments.back();
    segments.pop_back();
    if (LineOfSightByBruteForce(segment, segments, Ties::kPass)) continue;
    for (int shot = 0; shot < 200; ++shot, ++lines) {
      const Wide t = 1 + random() % 1022;
      const Wide dx = static_cast<int>(random() % 2001) - 1000;
      const Wide dy = static_cast<int>(random() % 1000) + 1;
      const LineEquation<Wide> line = LineThrough<Wide>(segment, t, 1023, dx, dy);
      const std::optional<Ratio<Wide>> own = HeightOver<Wide>(line, segment);
      const bool seen = std::all_of(segments.begin(), segments.end(), [&](const Segment& f) {
        const std::optional<Ratio<Wide>> height = HeightOver<Wide>(line, f);
        return !height || *height < *own;
      });
      ASSERT_FALSE(seen) << "round " << round;
    }
  }
  EXPECT_GT(lines, 10'000);
}

// Thm 3: hor(A u B) = hor(hor(A) u hor(B)).
TEST(BruteForce, ReducingTwoPartsFirstChangesNothing) {
  std::mt19937 random(4);
  for (int round = 0; round < 24; ++round) {
    const std::int32_t max_height = std::array{1, 2, 3, 9}[static_cast<std::size_t>(round) % 4];
    const Dem dem = RandomDem({.columns = 4, .rows = 4, .max_height = max_height}, random);
    const OracleMesh mesh = MeshOf(*Terrain::Build(dem));
    const std::vector<Segment> all = SegmentsOfEdges(mesh, EdgesOf(mesh));
    std::vector<Segment> parts[2];
    for (const Segment& s : all) parts[random() % 2].push_back(s);
    std::vector<Segment> joined = Reduce(parts[0]);
    const std::vector<Segment> other = Reduce(parts[1]);
    joined.insert(joined.end(), other.begin(), other.end());
    ASSERT_EQ(SortedEdges(Reduce(joined)), SortedEdges(Reduce(all))) << DrawAscii(dem);
  }
}

TEST(BruteForce, AffineMapsOfThePlanAndScaledHeightsKeepTheHorizon) {
  struct Map {
    std::int32_t xx, xy, yx, yy, factor, offset;
  };
  constexpr std::array<Map, 6> kMaps{{{0, -1, 1, 0, 1, 0},    // a quarter turn
                                      {-1, 0, 0, 1, 1, 0},    // a reflection: the other diagonal
                                      {0, 1, 1, 0, 1, 0},     // a reflection: the same diagonal
                                      {1, 3, 0, 1, 1, 0},     // a shear
                                      {2, 0, 0, 5, 7, -100},  // scales, lifted
                                      {3, -2, 5, 4, 1, 0}}};  // anything
  std::mt19937 random(5);
  for (int round = 0; round < 40; ++round) {
    const Dem dem = AnyRandomDem(3, 5, random);
    Result<Terrain> terrain = Terrain::Build(dem);
    if (!terrain) continue;
    const OracleMesh mesh = MeshOf(*terrain);
    const Map& map = kMaps[static_cast<std::size_t>(round) % kMaps.size()];
    OracleMesh mapped = mesh;
    for (Point3i& p : mapped.points) {
      // Posts without data belong to no triangle: their heights do not matter.
      const std::int32_t z = p.z == kNoHeight ? 0 : p.z;
      p = {map.xx * p.x + map.xy * p.y, map.yx * p.x + map.yy * p.y, map.factor * z + map.offset};
    }
    ASSERT_EQ(HorizonByBruteForce(mapped), HorizonByBruteForce(mesh)) << DrawAscii(dem);
  }
}

}  // namespace
}  // namespace farhorizon

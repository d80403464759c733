#include "core/horizon/lines_of_sight/visible_region.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "core/geometry/direction.h"
#include "core/horizon/find_horizon.h"
#include "tests/oracles/lines_of_sight_by_definition.h"
#include "tests/support/ascii_dem.h"
#include "tests/support/effort.h"
#include "tests/support/matchers.h"
#include "tests/support/terrains.h"

namespace farhorizon {
namespace {

using oracle::DyadicNumber;
using oracle::Wide;

using OracleDirection = std::array<Wide, 2>;

TargetSegment TargetOf(const Segment& s) {
  return s.a.z <= s.b.z ? TargetSegment{s.a, s.b, Ties::kPass}
                        : TargetSegment{s.b, s.a, Ties::kPass};
}

// By digits of 60 bits. For the conversion of Boost from fewer bits to more, g++ 12 warns of a read
// past the end of the smaller number.
Int1280 ToInt1280(const Wide& value) {
  const Wide magnitude = value < 0 ? Wide(-value) : value;
  Int1280 result;
  for (int shift = 960; shift >= 0; shift -= 60) {
    const Wide digit = (magnitude >> static_cast<unsigned>(shift)) & ((Wide(1) << 60) - 1);
    result = (result << 60) + Int1280(static_cast<std::int64_t>(digit));
  }
  return value < 0 ? Int1280(-result) : result;
}

// t as it is counted from the lower end.
WideDyadic FromLow(const Segment& s, const DyadicNumber& t) {
  const Wide whole = Wide(1) << static_cast<unsigned>(t.exponent);
  return {ToInt1280(s.a.z <= s.b.z ? t.numerator : Wide(whole - t.numerator)), t.exponent};
}

// The sign of the cross product of a curve's direction at t and `direction`.
int TurnInPlan(const BoundaryCurve& curve, const WideDyadic& t, const WideVector& direction) {
  if (curve.kind == BoundaryCurve::Kind::kAlong) return 1;
  if (curve.kind == BoundaryCurve::Kind::kAgainst) return -1;
  return CrossSign(curve.v.At(t), direction);
}

// Whether the region has the line, in the interior of its directions.
bool Contains(const VisibleRegion& region, const Segment& edge, const DyadicNumber& t,
              OracleDirection direction) {
  const TargetSegment target = TargetOf(edge);
  const std::int64_t x = std::int64_t{target.high.x} - target.low.x;
  const std::int64_t y = std::int64_t{target.high.y} - target.low.y;
  if (x * direction[1] - y * direction[0] < 0) direction = {-direction[0], -direction[1]};
  const WideVector v{ToInt1280(direction[0]), ToInt1280(direction[1])};
  const WideDyadic at = FromLow(edge, t);
  return std::any_of(region.cells().begin(), region.cells().end(), [&](const StripCell& cell) {
    return Compare(cell.from.root, at) <= 0 && Compare(cell.to.root, at) >= 0 &&
           TurnInPlan(cell.first, at, v) > 0 && TurnInPlan(cell.last, at, v) < 0;
  });
}

DyadicNumber ToOracle(const Segment& s, const SamplePoint& point) {
  const WideDyadic t = point.wide ? *point.wide : Widened(point.t);
  const Wide n(t.n);
  const Wide whole = Wide(1) << static_cast<unsigned>(t.k);
  return {s.a.z <= s.b.z ? n : Wide(whole - n), t.k};
}

// Points of the edge: one in every range between ends of cells, and some by chance.
std::vector<DyadicNumber> PointsToTry(const VisibleRegion& region, const Segment& edge,
                                      std::mt19937& random) {
  std::vector<IsolatedRoot> ends = {IsolatedRoot::Zero(), IsolatedRoot::One()};
  for (const StripCell& cell : region.cells()) {
    ends.push_back(cell.from);
    ends.push_back(cell.to);
  }
  std::sort(ends.begin(), ends.end(),
            [](const IsolatedRoot& a, const IsolatedRoot& b) { return Compare(a, b) < 0; });
  std::vector<DyadicNumber> points;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    if (Compare(ends[i], ends[i + 1]) >= 0) continue;
    points.push_back(ToOracle(edge, PointBetween(ends[i], ends[i + 1])));
  }
  for (int i = 0; i < 2; ++i) points.push_back({Wide(1 + random() % 1023), 10});
  return points;
}

struct Tally {
  std::int64_t lines = 0;
  std::int64_t lines_of_sight = 0;
};

// The region against the definition: in all directions at some points, and at all points in some
// directions.
testing::AssertionResult IsTheDefinition(const VisibleRegion& region, const Segment& edge,
                                         const std::vector<Segment>& others, std::mt19937& random,
                                         Tally& tally) {
  const auto agrees = [&](const DyadicNumber& t, const OracleDirection& direction) {
    const bool expected = IsLineOfSight(edge, t, direction, others);
    ++tally.lines;
    tally.lines_of_sight += expected ? 1 : 0;
    return Contains(region, edge, t, direction) == expected;
  };
  const auto differs = [&](const DyadicNumber& t, const OracleDirection& direction) {
    return testing::AssertionFailure()
           << "edge " << DrawSegments({edge}) << " t " << t.numerator << " / 2^" << t.exponent
           << " direction " << direction[0] << ", " << direction[1] << ": the definition says "
           << IsLineOfSight(edge, t, direction, others);
  };
  for (const DyadicNumber& t : PointsToTry(region, edge, random)) {
    for (const OracleDirection& direction : DirectionsAt(edge, t, others)) {
      if (!agrees(t, direction)) return differs(t, direction);
    }
  }
  for (int i = 0; i < 3; ++i) {
    // Not a contour direction of a face: along one the definition meets ties only.
    const auto dx = static_cast<std::int64_t>(random() % 2'000'001) - 1'000'000;
    const auto dy = static_cast<std::int64_t>(random() % 1'000'000) + 1;
    if (dx * (edge.b.y - edge.a.y) == dy * (edge.b.x - edge.a.x)) continue;
    for (const DyadicNumber& t : PointsAlong(edge, dx, dy, others)) {
      if (!agrees(t, {dx, dy})) return differs(t, {dx, dy});
    }
  }
  return testing::AssertionSuccess();
}

// Every horizon edge of a terrain over the others, in turn with and without the sweep's virtual
// occluders.
testing::AssertionResult RegionsAreTheDefinition(const Dem& dem, std::mt19937& random,
                                                 Tally& tally) {
  const Result<Terrain> terrain = Terrain::Build(dem);
  if (!terrain) return testing::AssertionSuccess();
  const Horizon horizon = *FindHorizon(*terrain, {}, {});
  SegmentIndex index(dem.columns, dem.rows);
  for (const HorizonEdge& e : horizon.edges) {
    index.Insert({terrain->Point(e.edge.a), terrain->Point(e.edge.b)});
  }
  for (std::size_t i = 0; i < horizon.edges.size(); ++i) {
    const Edge edge = horizon.edges[i].edge;
    const Segment segment{terrain->Point(edge.a), terrain->Point(edge.b)};
    VisibleRegion region(TargetOf(segment));
    if (i % 2 == 0) {
      for (const Segment& s : horizon.virtual_occluders.Of(i)) region.AddOccluder({s.a, s.b});
    }
    region.AddOccluders(index, static_cast<std::int32_t>(i));
    if (region.cells().empty()) return testing::AssertionFailure() << "no line of sight";
    std::vector<Edge> others = terrain->Edges();
    std::erase(others, edge);
    testing::AssertionResult same =
        IsTheDefinition(region, segment, SegmentsOf(*terrain, others), random, tally);
    if (!same) return same << "\n" << DrawAscii(dem);
  }
  return testing::AssertionSuccess();
}

void ExpectTheDefinitionOnRandomTerrains(std::int32_t min_side, std::int32_t max_side, int rounds,
                                         std::uint32_t seed) {
  std::mt19937 random(seed);
  Tally tally;
  for (int round = 0; round < rounds; ++round) {
    const Dem dem = AnyRandomDem(min_side, max_side, random);
    ASSERT_TRUE(RegionsAreTheDefinition(dem, random, tally)) << "round " << round;
  }
  EXPECT_GT(tally.lines_of_sight, tally.lines / 20);
  EXPECT_LT(tally.lines_of_sight, tally.lines * 19 / 20);
  testing::Test::RecordProperty("lines", std::to_string(tally.lines));
}

TEST(VisibleRegion, IsTheDefinitionOnTheNamedTerrains) {
  std::mt19937 random(1);
  Tally tally;
  for (const NamedTerrain& named : NamedTerrains()) {
    EXPECT_TRUE(RegionsAreTheDefinition(named.dem, random, tally)) << named.name;
  }
}

TEST(VisibleRegion, IsTheDefinitionOnSmallRandomTerrains) {
  ExpectTheDefinitionOnRandomTerrains(2, 4, Rounds(400), 2);
}

TEST(VisibleRegion, IsTheDefinitionOnRandomTerrainsOfUpToSevenPosts) {
  ExpectTheDefinitionOnRandomTerrains(5, 7, Rounds(20), 3);
}

TEST(VisibleRegionLong, IsTheDefinitionOnThousandsOfRandomTerrains) {
  ExpectTheDefinitionOnRandomTerrains(2, 4, Rounds(8'000), 101);
  ExpectTheDefinitionOnRandomTerrains(4, 7, Rounds(500), 102);
}

TEST(VisibleRegion, IsTheDefinitionOnCliffs) {
  constexpr std::int32_t kCliff = 1 << 25;
  std::mt19937 random(4);
  Tally tally;
  for (int round = 0; round < Rounds(20); ++round) {
    // All over the range; or cliffs whose tops and feet are a quantum apart: the narrowest gaps.
    const Dem dem = MakeDem(3, 3, [&](std::int32_t, std::int32_t) {
      if (round % 2 == 0) return static_cast<std::int32_t>(random() >> 2U);
      return (random() % 2 == 0 ? 0 : kCliff) + static_cast<std::int32_t>(random() % 3);
    });
    ASSERT_TRUE(RegionsAreTheDefinition(dem, random, tally)) << "round " << round;
  }
}

std::int64_t SideOfLine(const Point3i& p, const Segment& s) {
  return std::int64_t{s.b.x - s.a.x} * (p.y - s.a.y) - std::int64_t{s.b.y - s.a.y} * (p.x - s.a.x);
}

// Segments with ends at few posts: their curves often touch without crossing, half way along the
// edge.
TEST(VisibleRegion, IsTheDefinitionBehindAnyTwoSegments) {
  std::mt19937 random(6);
  const auto draw = [&random] {
    const auto number = [&random](unsigned below) {
      return static_cast<std::int32_t>(random() % below);
    };
    Segment s;
    while (s.a.x == s.b.x && s.a.y == s.b.y) {
      s = {{number(5), number(5), number(5)}, {number(5), number(5), number(5)}};
    }
    return s;
  };
  Tally tally;
  for (int round = 0; round < Rounds(4000); ++round) {
    const Segment edge = draw();
    std::vector<Segment> others;
    while (others.size() < 2) {
      const Segment other = draw();
      // Not over the edge: on one side of its line, or across the line ahead of it or behind it.
      const bool beside = SideOfLine(other.a, edge) * SideOfLine(other.b, edge) > 0;
      const bool past = SideOfLine(edge.a, other) * SideOfLine(edge.b, other) > 0;
      if (beside || past) others.push_back(other);
    }
    VisibleRegion region(TargetOf(edge));
    SegmentIndex index(5, 5);
    for (const Segment& other : others) index.Insert(other);
    region.AddOccluders(index, -1);
    ASSERT_TRUE(IsTheDefinition(region, edge, others, random, tally)) << DrawSegments(others);
  }
}

TEST(Order, OfCurvesThatOnlyTouchIsThatOnEitherSide) {
  // Their cross product is (2 t - 1)^2: parallel half way.
  const BoundaryCurve a{BoundaryCurve::Kind::kMoving, {1, 0, 0, 1}};
  const BoundaryCurve b{BoundaryCurve::Kind::kMoving, {4, 1, -4, 0}};
  for (const SamplePoint& point :
       {SamplePoint{{1, 2}, {}}, SamplePoint{{1, 1}, {}}, SamplePoint{{3, 2}, {}}}) {
    EXPECT_EQ(Order(a, b, point), 1);
    EXPECT_EQ(Order(b, a, point), -1);
    EXPECT_EQ(Order(a, a, point), 0);
  }
}

TEST(VisibleRegion, IsTheDefinitionOnFractalTerrain) {
  std::mt19937 random(5);
  Tally tally;
  ASSERT_TRUE(RegionsAreTheDefinition(FractalDem(9, 40, 100, 3), random, tally));
}

}  // namespace
}  // namespace farhorizon

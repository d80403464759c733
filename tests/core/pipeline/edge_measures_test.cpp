#include "core/pipeline/edge_measures.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/horizon/find_horizon.h"
#include "core/horizon/lines/highest_over_line.h"
#include "tests/support/ascii_dem.h"
#include "tests/support/metre_steps.h"
#include "tests/support/terrains.h"

namespace farhorizon {
namespace {

using testing::ElementsAre;

struct MeasuredEdge {
  Edge edge;
  EdgeMeasures measures;
};

std::vector<MeasuredEdge> MeasuresOn(const Dem& dem, const GroundStep& step) {
  const Terrain terrain = *Terrain::Build(dem);
  const Horizon horizon = *FindHorizon(terrain, {}, {});
  const std::vector<LinesOfSight> sights = *FindLinesOfSight(terrain, horizon, 1, {});
  std::vector<MeasuredEdge> edges;
  for (std::size_t i = 0; i < sights.size(); ++i) {
    const Edge edge = horizon.edges[i].edge;
    const Point3i a = terrain.Point(edge.a);
    const Point3i b = terrain.Point(edge.b);
    edges.push_back(
        {edge, MeasuresOf(sights[i],
                          {static_cast<double>(b.x) - a.x, static_cast<double>(b.y) - a.y}, step)});
  }
  return edges;
}

double SumOfMeasures(const std::vector<MeasuredEdge>& edges) {
  double sum = 0;
  for (const MeasuredEdge& v : edges) sum += v.measures.line_measure_m;
  return sum;
}

// A random terrain in which no two posts have one height: no ties over open sets of lines.
Dem Unlevel(std::int32_t columns, std::int32_t rows, std::uint32_t seed) {
  std::vector<std::int32_t> heights(static_cast<std::size_t>(columns) *
                                    static_cast<std::size_t>(rows));
  for (std::size_t i = 0; i < heights.size(); ++i) heights[i] = static_cast<std::int32_t>(i) * 7;
  std::mt19937 random(seed);
  std::shuffle(heights.begin(), heights.end(), random);
  return MakeDem(columns, rows, [&](std::int32_t c, std::int32_t r) {
    return heights[static_cast<std::size_t>(r) * static_cast<std::size_t>(columns) +
                   static_cast<std::size_t>(c)];
  });
}

// Cliffs of 2^29 quanta, whose tops differ by 3: the edge down the cliff is seen between two others
// that cross in its view 10^-9 of its length below its top, from less than a millionth of a degree.
// A double for that place tells the direction to some 10^-5 degrees only.
TEST(EdgeMeasures, AzimuthsAreTrueWhereDirectionsTurnFarInAShortWay) {
  constexpr std::int32_t kTop = 1 << 29;
  const std::vector<std::vector<std::int32_t>> heights = {
      {kTop, kTop + 3, kTop, 0, 0, kTop}, {0, 0, -(1 << 20), kTop + 3, 0, kTop + 3}};
  const Dem dem = MakeDem(6, 2, [&](std::int32_t c, std::int32_t r) {
    return heights[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)];
  });
  const std::vector<MeasuredEdge> edges = MeasuresOn(dem, kMetreSteps);
  const auto cliff = std::find_if(edges.begin(), edges.end(), [](const MeasuredEdge& v) {
    return v.edge.a == 1 && v.edge.b == 7;
  });
  ASSERT_NE(cliff, edges.end());
  // Exactly: 89.9999996798 to 90.0000003202.
  ASSERT_EQ(cliff->measures.azimuths.size(), 1U);
  EXPECT_NEAR(cliff->measures.azimuths[0][0], 89.999999, 1e-9);
  EXPECT_NEAR(cliff->measures.azimuths[0][1], 90.000001, 1e-9);
  EXPECT_NEAR(cliff->measures.angular_share * 180, 6.404e-7, 2e-9);
}

// O1: each slanted edge is seen in the quarter turn in which the one beside it does not rise above
// it.
TEST(EdgeMeasures, EachEdgeOfAPyramidIsSeenInAQuarterTurn) {
  const std::vector<MeasuredEdge> edges = MeasuresOn(AsciiDem(".0.\n010\n.0."), kMetreSteps);
  ASSERT_EQ(edges.size(), 4U);
  for (const MeasuredEdge& v : edges) {
    // The edges to the north and to the south lie north: seen from the east and the west, 45
    // degrees to each side. The others across.
    const bool upright = v.edge == Edge{1, 4} || v.edge == Edge{4, 7};
    if (upright) {
      EXPECT_THAT(v.measures.azimuths, ElementsAre(std::array{45.0, 135.0}));
    } else {
      EXPECT_THAT(v.measures.azimuths, ElementsAre(std::array{135.0, 225.0}));
    }
    EXPECT_THAT(v.measures.spans, ElementsAre(std::array{0.0, 1.0}));
    EXPECT_DOUBLE_EQ(v.measures.angular_share, 0.5);
    // The integral of sin over the quarter turn around the edge's normal.
    EXPECT_NEAR(v.measures.line_measure_m, std::numbers::sqrt2, 1e-12);
  }
}

TEST(EdgeMeasures, ALoneRidgeIsSeenFromAllAround) {
  // 9 between two 0s in a row, and another row of 0: the ridge's ends are posts of one height.
  const std::vector<MeasuredEdge> edges = MeasuresOn(AsciiDem("0000\n0990\n0000"), kMetreSteps);
  const auto ridge = std::find_if(edges.begin(), edges.end(), [](const MeasuredEdge& v) {
    return v.edge == Edge{5, 6};
  });
  ASSERT_NE(ridge, edges.end());
  EXPECT_THAT(ridge->measures.azimuths, ElementsAre(std::array{0.0, 180.0}));
  EXPECT_DOUBLE_EQ(ridge->measures.angular_share, 1);
  EXPECT_NEAR(ridge->measures.line_measure_m, 2, 1e-12);
}

// [Crofton1868]: the lines that meet a convex region measure its perimeter, and each has its
// skyline on one edge. So nothing is missing, and nothing is there twice.
TEST(EdgeMeasures, MeasuresAddUpToThePerimeter) {
  for (std::uint32_t seed = 1; seed <= 30; ++seed) {
    const auto columns = static_cast<std::int32_t>(3 + seed % 20);
    const auto rows = static_cast<std::int32_t>(3 + seed * 7 % 17);
    const double perimeter = 2.0 * (columns - 1 + rows - 1);
    EXPECT_NEAR(SumOfMeasures(MeasuresOn(Unlevel(columns, rows, seed), kMetreSteps)), perimeter,
                1e-6 * perimeter)
        << seed;
  }
}

TEST(EdgeMeasures, MeasuresAddUpToThePerimeterOnStretchedAndSlantedGrounds) {
  // A parallelogram: columns 3 m to the north-east, rows 20 m to the south-south-east; and
  // mirrored.
  for (const GroundStep& step : {GroundStep{2, 2.2, 7.5, -18}, GroundStep{-2, 2.2, 7.5, -18}}) {
    const double perimeter = 2 * (11 * std::hypot(step.column_east_m, step.column_north_m) +
                                  9 * std::hypot(step.row_east_m, step.row_north_m));
    EXPECT_NEAR(SumOfMeasures(MeasuresOn(Unlevel(12, 10, 5), step)), perimeter, 1e-6 * perimeter);
  }
}

bool Within(const std::vector<std::array<double, 2>>& intervals, double value, double margin) {
  return std::any_of(intervals.begin(), intervals.end(), [&](const std::array<double, 2>& i) {
    return value >= i[0] - margin && value <= i[1] + margin;
  });
}

// By definition: each edge that has the greatest height over a random line has the line's azimuth
// among its azimuths and the crossing point in its spans.
TEST(EdgeMeasures, RandomLinesSeeOnlyWhatIsPublished) {
  const Dem dem = Unlevel(9, 8, 11);
  const Terrain terrain = *Terrain::Build(dem);
  const GroundStep step{1, 0.25, 0.5, -1.5};
  const std::vector<MeasuredEdge> edges = MeasuresOn(dem, step);
  std::mt19937 random(6);
  int hits = 0;
  for (int shot = 0; shot < 20'000; ++shot) {
    const PlanLine line{static_cast<std::int32_t>(random() % 17),
                        static_cast<std::int32_t>(random() % 15),
                        static_cast<std::int32_t>(random() % 20'001) - 10'000,
                        static_cast<std::int32_t>(random() % 10'000) + 1};
    const ExactHeight highest = *HighestOver(terrain, line);
    const double east = step.column_east_m * line.dc + step.row_east_m * line.dr;
    const double north = step.column_north_m * line.dc + step.row_north_m * line.dr;
    double azimuth = std::atan2(east, north) * 180 / std::numbers::pi;
    if (azimuth < 0) azimuth += 180;
    int found = 0;
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const Segment s{terrain.Point(edges[i].edge.a), terrain.Point(edges[i].edge.b)};
      const std::optional<ExactHeight> own = HeightOver(s, line);
      if (!own || Compare(*own, highest) != 0) continue;
      ++found;
      const double height =
          static_cast<double>(own->numerator) / static_cast<double>(own->denominator);
      const double t = (height - s.a.z) / (static_cast<double>(s.b.z) - s.a.z);
      // Lines through a post may touch an edge that only ends there.
      if (t < 1e-9 || t > 1 - 1e-9) continue;
      ++hits;
      EXPECT_TRUE(Within(edges[i].measures.azimuths, azimuth, 1e-5) ||
                  Within(edges[i].measures.azimuths, azimuth + 180, 1e-5))
          << edges[i].edge.a << '-' << edges[i].edge.b << " at " << azimuth;
      EXPECT_TRUE(Within(edges[i].measures.spans, t, 1e-6)) << t;
    }
    EXPECT_GE(found, 1);
  }
  EXPECT_GT(hits, 15'000);
}

TEST(EdgeMeasures, TheHalfTurnBeginsAtNorth) {
  for (const MeasuredEdge& v : MeasuresOn(Unlevel(10, 10, 3), GroundStep{0.6, 0.8, 0.8, -0.6})) {
    double last = -1;
    for (const auto& [from, to] : v.measures.azimuths) {
      EXPECT_GE(from, 0);
      EXPECT_LT(from, 180);
      EXPECT_GT(from, last);
      EXPECT_GT(to, from);
      EXPECT_LE(to, from + 180);
      last = to;
    }
    EXPECT_FALSE(v.measures.azimuths.empty());
    EXPECT_LE(last - 180, v.measures.azimuths.front()[0]);
  }
}

}  // namespace
}  // namespace farhorizon

#include "core/horizon/trace/sweep_trace.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <stop_token>

#include <gtest/gtest.h>

#include "tests/support/ascii_dem.h"
#include "tests/support/effort.h"
#include "tests/support/terrains.h"

namespace farhorizon {
namespace {

double TurnOfTrace(PlanPoint a, PlanPoint b, PlanPoint c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool IsClosed(const std::vector<PlanPoint>& contour) {
  return contour.size() > 3 && contour.front().x == contour.back().x &&
         contour.front().y == contour.back().y;
}

TEST(ContoursAt, GoAroundASummitOnceAndAreClosed) {
  const Dem dem = AsciiDem("000\n090\n000");
  const Terrain terrain = *Terrain::Build(dem);
  const auto contours = ContoursAt(terrain, 3);
  ASSERT_EQ(contours.size(), 1U);
  EXPECT_TRUE(IsClosed(contours[0]));
  EXPECT_EQ(contours[0].size(), 7U) << "six edges end at a post in the middle";
  for (const PlanPoint& p : contours[0]) {
    const double off = std::max(std::abs(p.x - 1), std::abs(p.y - 1));
    EXPECT_NEAR(off, 2.0 / 3, 1e-12) << "a third of the way up";
  }
}

TEST(ContoursAt, EndAtTheBorderOfTheTerrain) {
  const Dem dem = AsciiDem("990\n990\n990");
  const auto contours = ContoursAt(*Terrain::Build(dem), 5);
  ASSERT_EQ(contours.size(), 1U);
  EXPECT_FALSE(IsClosed(contours[0]));
  EXPECT_EQ(std::abs(contours[0].front().y - contours[0].back().y), 2);
}

TEST(ContoursAt, HaveGroundAtTheHeightInside) {
  const Dem dem = AsciiDem("0000\n0550\n0550\n0000");
  EXPECT_EQ(ContoursAt(*Terrain::Build(dem), 5).size(), 1U);
  EXPECT_EQ(ContoursAt(*Terrain::Build(dem), 6).size(), 0U);
}

TEST(TraceSweep, HasTwoHullsForTwoSummitsWithFourBitangentsAllActive) {
  const Dem dem = AsciiDem(R"(
      0 0 0 0 0 0 0
      0 9 0 0 0 8 0
      0 0 0 0 0 0 0)");
  const Terrain terrain = *Terrain::Build(dem);
  const SweepTrace trace = *TraceSweep(terrain, 4, {});
  EXPECT_EQ(trace.height, 4);
  EXPECT_EQ(trace.contours.size(), 2U);
  EXPECT_EQ(trace.hulls.size(), 2U);
  ASSERT_EQ(trace.bitangents.size(), 4U);
  for (const SweepTrace::Bitangent& b : trace.bitangents) EXPECT_TRUE(b.active);
  EXPECT_EQ(trace.candidates.size(), 12U);
  EXPECT_EQ(trace.horizon_points.size(), 12U);
  EXPECT_EQ((*TraceSweep(terrain, 9, {})).hulls.size(), 1U);
}

constexpr double kRounded = 1e-6;

bool IsConvex(const std::vector<PlanPoint>& hull) {
  for (std::size_t i = 0; i + 2 < hull.size(); ++i) {
    if (TurnOfTrace(hull[i], hull[i + 1], hull[i + 2]) <= -kRounded) return false;
  }
  return true;
}

bool IsIn(const std::vector<PlanPoint>& hull, PlanPoint p) {
  for (std::size_t i = 0; i < hull.size(); ++i) {
    if (TurnOfTrace(hull[i], hull[(i + 1) % hull.size()], p) < -kRounded) return false;
  }
  return hull.size() > 2 || std::hypot(hull[0].x - p.x, hull[0].y - p.y) < 2;
}

// The posts of the terrain, the highest first.
std::vector<VertexId> ByHeight(const Terrain& terrain) {
  std::vector<VertexId> posts;
  for (VertexId v = 0; v < terrain.post_count(); ++v) {
    if (terrain.IsVertex(v)) posts.push_back(v);
  }
  std::sort(posts.begin(), posts.end(),
            [&terrain](VertexId a, VertexId b) { return terrain.Point(a).z > terrain.Point(b).z; });
  return posts;
}

TEST(TraceSweep, HasConvexHullsAroundAllGroundAboveTheHeight) {
  std::mt19937 random(1);
  for (int round = 0; round < Rounds(60); ++round) {
    const Dem dem = AnyLandscape(9, 24, random);
    Result<Terrain> terrain = Terrain::Build(dem);
    if (!terrain) continue;
    const std::vector<VertexId> posts = ByHeight(*terrain);
    const std::int32_t height = terrain->Point(posts[posts.size() / 2]).z;
    const SweepTrace trace = *TraceSweep(*terrain, height, {});
    const std::size_t m = trace.hulls.size();
    EXPECT_EQ(trace.bitangents.size(), m * (m - 1) / 2 * 4);
    EXPECT_TRUE(std::all_of(trace.hulls.begin(), trace.hulls.end(), IsConvex)) << DrawAscii(dem);
    for (const VertexId v : posts) {
      if (terrain->Point(v).z < height) break;
      const PlanPoint p{static_cast<double>(dem.Column(v)), static_cast<double>(dem.Row(v))};
      EXPECT_TRUE(std::any_of(trace.hulls.begin(), trace.hulls.end(),
                              [p](const auto& hull) { return IsIn(hull, p); }))
          << DrawAscii(dem) << "height " << height << " post " << v;
    }
  }
}

TEST(TraceSweep, RefusesHeightsWithoutASlice) {
  const Dem dem = AsciiDem("000\n090\n000");
  const Terrain terrain = *Terrain::Build(dem);
  for (const std::int32_t height : {10, -1, -5}) {
    Result<SweepTrace> trace = TraceSweep(terrain, height, {});
    ASSERT_FALSE(trace) << height;
    EXPECT_EQ(trace.error().kind, "no-such-level");
  }
}

TEST(TraceSweep, StopsWhenAskedTo) {
  const Dem dem = FractalDem(33, 900, 100, 2);
  std::stop_source source;
  source.request_stop();
  Result<SweepTrace> trace = TraceSweep(*Terrain::Build(dem), 300, {.stop = source.get_token()});
  ASSERT_FALSE(trace);
  EXPECT_EQ(trace.error().code, ErrorCode::kCancelled);
}

}  // namespace
}  // namespace farhorizon

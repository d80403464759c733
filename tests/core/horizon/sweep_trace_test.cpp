#include "core/horizon/sweep_trace.h"

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

double Turn(PlanPoint a, PlanPoint b, PlanPoint c) {
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

TEST(ContoursAt, CountWhatLevelGroundIsInside) {
  const Dem dem = AsciiDem("0000\n0550\n0550\n0000");
  EXPECT_EQ(ContoursAt(*Terrain::Build(dem), 5).size(), 1U);
  EXPECT_EQ(ContoursAt(*Terrain::Build(dem), 6).size(), 0U);
}

TEST(TraceSweep, SeesTwoSummitsAsTwoHullsWithFourBitangentsAllActive) {
  const Dem dem = AsciiDem(R"(
      0 0 0 0 0 0 0
      0 9 0 0 0 8 0
      0 0 0 0 0 0 0)");
  const Terrain terrain = *Terrain::Build(dem);
  const SweepTrace trace = *TraceSweep(terrain, 4, {});
  EXPECT_EQ(trace.level, 4);
  EXPECT_EQ(trace.contours.size(), 2U);
  EXPECT_EQ(trace.hulls.size(), 2U);
  ASSERT_EQ(trace.bitangents.size(), 4U);
  for (const SweepTrace::Bitangent& b : trace.bitangents) EXPECT_TRUE(b.active);
  EXPECT_EQ(trace.candidates.size(), 12U);
  EXPECT_EQ(trace.seen.size(), 12U);
  EXPECT_EQ((*TraceSweep(terrain, 9, {})).hulls.size(), 1U);
}

TEST(TraceSweep, KeepsHullsConvexAndRoundAllGroundAboveTheLevel) {
  std::mt19937 random(1);
  for (int round = 0; round < Rounds(60); ++round) {
    const Dem dem = AnyLandscape(9, 24, random);
    Result<Terrain> terrain = Terrain::Build(dem);
    if (!terrain) continue;
    std::vector<std::int32_t> heights;
    for (VertexId v = 0; v < terrain->post_count(); ++v) {
      if (terrain->IsVertex(v)) heights.push_back(terrain->Point(v).z);
    }
    std::sort(heights.begin(), heights.end());
    const std::int32_t level = heights[heights.size() / 2];
    if (level == heights.front()) continue;
    const SweepTrace trace = *TraceSweep(*terrain, level, {});
    const std::size_t m = trace.hulls.size();
    EXPECT_EQ(trace.bitangents.size(), m * (m - 1) / 2 * 4);
    constexpr double kRounded = 1e-6;
    for (const auto& hull : trace.hulls) {
      for (std::size_t i = 0; i + 2 < hull.size(); ++i) {
        EXPECT_GT(Turn(hull[i], hull[i + 1], hull[i + 2]), -kRounded);
      }
    }
    for (VertexId v = 0; v < terrain->post_count(); ++v) {
      if (!terrain->IsVertex(v) || terrain->Point(v).z < level) continue;
      const PlanPoint p{static_cast<double>(dem.Column(v)), static_cast<double>(dem.Row(v))};
      const bool inside = std::any_of(trace.hulls.begin(), trace.hulls.end(), [&](const auto& h) {
        for (std::size_t i = 0; i < h.size(); ++i) {
          if (Turn(h[i], h[(i + 1) % h.size()], p) < -kRounded) return false;
        }
        return h.size() > 2 || std::hypot(h[0].x - p.x, h[0].y - p.y) < 2;
      });
      EXPECT_TRUE(inside) << DrawAscii(dem) << "level " << level << " post " << v;
    }
  }
}

TEST(TraceSweep, RefusesLevelsWithoutASlice) {
  const Dem dem = AsciiDem("000\n090\n000");
  const Terrain terrain = *Terrain::Build(dem);
  for (const std::int32_t level : {10, -1, -5}) {
    Result<SweepTrace> trace = TraceSweep(terrain, level, {});
    ASSERT_FALSE(trace) << level;
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

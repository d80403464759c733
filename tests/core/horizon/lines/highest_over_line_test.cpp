#include "core/horizon/lines/highest_over_line.h"

#include <gtest/gtest.h>

#include "core/horizon/horizon.h"

namespace farhorizon {
namespace {

TEST(HeightOver, IsTheHeightAtTheCrossing) {
  const Segment segment{{0, 0, 0}, {4, 0, 10}};
  const auto height = HeightOver(segment, {2, 5, 0, 1});  // the line x = 1
  ASSERT_TRUE(height);
  EXPECT_EQ(Compare(*height, {5, 2}), 0);
  EXPECT_FALSE(HeightOver(segment, {10, 0, 0, 1}));
}

TEST(HeightOver, TouchingAnEndCounts) {
  const auto height = HeightOver({{0, 0, 3}, {4, 0, 10}}, {0, 8, 1, 1});
  EXPECT_FALSE(height);
  const auto touching = HeightOver({{0, 0, 3}, {4, 0, 10}}, {0, 0, 1, 1});
  ASSERT_TRUE(touching);
  EXPECT_EQ(Compare(*touching, {3, 1}), 0);
}

TEST(HeightOver, AlongTheSegmentItIsItsHigherEnd) {
  const auto height = HeightOver({{0, 0, 3}, {4, 4, 10}}, {2, 2, 1, 1});
  ASSERT_TRUE(height);
  EXPECT_EQ(Compare(*height, {10, 1}), 0);
}

TEST(HighestOver, OfATerrainIsThatOfAllItsEdges) {
  Dem dem;
  dem.columns = 5;
  dem.rows = 4;
  for (int i = 0; i < 20; ++i) dem.heights.push_back(i == 7 ? kNoHeight : (i * 37) % 11);
  const Terrain terrain = *Terrain::Build(dem);
  std::vector<Segment> edges;
  for (const Edge e : terrain.Edges()) edges.push_back({terrain.Point(e.a), terrain.Point(e.b)});
  for (int x = -1; x < 11; ++x) {
    for (int dc = -3; dc <= 3; ++dc) {
      for (int dr = -3; dr <= 3; ++dr) {
        if (dc == 0 && dr == 0) continue;
        const PlanLine line{x, 3, dc, dr};
        const auto all = HighestOver(edges, line);
        const auto near = HighestOver(terrain, line);
        ASSERT_EQ(all.has_value(), near.has_value());
        if (all) {
          ASSERT_EQ(Compare(*all, *near), 0);
        }
      }
    }
  }
}

}  // namespace
}  // namespace farhorizon

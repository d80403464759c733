#include "core/pipeline/terrain_tiles/fill_plan.h"

#include <map>
#include <random>

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

using Edge = std::array<std::uint32_t, 2>;

// Twice the area of a triangulation. Each triangle has to be counter-clockwise, each of `edges` in
// one triangle, and each other side in two, in opposite senses.
std::int64_t Checked(const std::vector<LatticePoint>& points, const std::vector<Edge>& edges) {
  const auto triangles = TriangulateInside(points, edges);
  if (!triangles) {
    ADD_FAILURE() << triangles.error().message;
    return 0;
  }
  std::int64_t area = 0;
  std::map<Edge, int> sides;
  for (const auto& t : *triangles) {
    EXPECT_GT(Orientation(points[t[0]], points[t[1]], points[t[2]]), 0);
    area += (points[t[1]].x - points[t[0]].x) * (points[t[2]].y - points[t[0]].y) -
            (points[t[1]].y - points[t[0]].y) * (points[t[2]].x - points[t[0]].x);
    for (std::size_t k = 0; k < 3; ++k) ++sides[{t[k], t[(k + 1) % 3]}];
  }
  for (const Edge& edge : edges) {
    const Edge back = {edge[1], edge[0]};
    EXPECT_EQ(sides[edge] + sides[back], 1);
    sides.erase(edge);
    sides.erase(back);
  }
  for (const auto& [side, count] : sides) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ((sides[{side[1], side[0]}]), 1);
  }
  return area;
}

TEST(FillPlan, FillsASquareAroundASquare) {
  const std::vector<LatticePoint> points = {{0, 0}, {9, 0}, {9, 9}, {0, 9},
                                            {3, 3}, {6, 3}, {6, 6}, {3, 6}};
  EXPECT_EQ(Checked(points, {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}}),
            2 * (81 - 9));
}

TEST(FillPlan, FillsTwoTrianglesThatMeetInAPoint) {
  const std::vector<LatticePoint> points = {{0, 0}, {4, 4}, {0, 8}, {8, 0}, {8, 8}};
  EXPECT_EQ(Checked(points, {{0, 1}, {1, 2}, {2, 0}, {1, 3}, {3, 4}, {4, 1}}), 2 * 32);
}

TEST(FillPlan, FillsACombWhoseTeethHaveOneLength) {
  std::vector<LatticePoint> points;
  std::vector<Edge> edges;
  for (int i = 0; i < 6; ++i) {
    points.push_back({2 * i, 0});
    points.push_back({2 * i + 1, 10});
  }
  points.push_back({12, 0});
  points.push_back({6, 200});
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    edges.push_back({i, static_cast<std::uint32_t>((i + 1) % points.size())});
  }
  // Shoelace: the area of any simple ring.
  std::int64_t area = 0;
  for (const auto& [a, b] : edges) {
    area += points[a].x * points[b].y - points[b].x * points[a].y;
  }
  EXPECT_EQ(Checked(points, edges), std::abs(area));
}

TEST(FillPlan, RefusesEdgesThatCross) {
  const std::vector<LatticePoint> points = {{0, 0}, {9, 9}, {0, 9}, {9, 0}};
  EXPECT_FALSE(TriangulateInside(points, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}));
}

TEST(FillPlan, RefusesARingThatDoesNotClose) {
  EXPECT_FALSE(TriangulateInside({{0, 0}, {9, 0}, {9, 9}}, {{0, 1}, {1, 2}}));
}

// Random squares of a grid, joined to one region with holes and points where corners meet; moved,
// so that few edges are parallel.
TEST(FillPlan, FillsRandomRegions) {
  std::mt19937 random(7);  // NOLINT(cert-msc51-cpp): the same regions in each run
  constexpr int kPlanSide = 12;
  for (int run = 0; run < 60; ++run) {
    const bool straight = run % 3 == 0;
    std::vector<LatticePoint> points;
    for (int r = 0; r <= kPlanSide; ++r) {
      for (int c = 0; c <= kPlanSide; ++c) {
        const auto moved = [&] { return straight ? 0 : static_cast<int>(random() % 40); };
        const int dx = moved();
        points.push_back({100 * c + dx, 100 * r + moved()});
      }
    }
    const auto at = [](int c, int r) {
      return static_cast<std::uint32_t>(r * (kPlanSide + 1) + c);
    };
    std::map<Edge, int> senses;
    std::int64_t area = 0;
    const auto share = 1 + random() % 3;
    for (int r = 0; r < kPlanSide; ++r) {
      for (int c = 0; c < kPlanSide; ++c) {
        if (random() % 4 >= share) continue;
        const std::array<std::uint32_t, 4> ring = {at(c, r), at(c + 1, r), at(c + 1, r + 1),
                                                   at(c, r + 1)};
        for (std::size_t k = 0; k < 4; ++k) {
          const std::uint32_t a = ring[k];
          const std::uint32_t b = ring[(k + 1) % 4];
          area += points[a].x * points[b].y - points[b].x * points[a].y;
          if (senses.erase({b, a}) == 0) senses[{a, b}] = 1;
        }
      }
    }
    std::vector<Edge> edges;
    for (const auto& [edge, one] : senses) edges.push_back(edge);
    EXPECT_EQ(Checked(points, edges), area) << run;
  }
}

}  // namespace
}  // namespace farhorizon

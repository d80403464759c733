#include "core/pipeline/terrain_tiles/split_part.h"

#include <algorithm>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "core/exact/int128.h"

namespace farhorizon {
namespace {

Int128 AreaOf(const GlobePart& part, const std::vector<GlobeVertex>& vertices) {
  Int128 area = 0;
  for (const auto& t : part.triangles) {
    const LatticePoint& a = vertices[t[0]].place;
    const LatticePoint& b = vertices[t[1]].place;
    const LatticePoint& c = vertices[t[2]].place;
    area += Int128{b.x - a.x} * (c.y - a.y) - Int128{b.y - a.y} * (c.x - a.x);
  }
  return area;
}

std::set<std::uint32_t> OnLine(const GlobePart& part, const std::vector<GlobeVertex>& vertices,
                               std::int64_t x) {
  std::set<std::uint32_t> on;
  for (const auto& t : part.triangles) {
    for (const std::uint32_t v : t) {
      if (vertices[v].place.x == x) on.insert(v);
    }
  }
  return on;
}

// A fan of triangles around a point, with corners on the line and off it.
TEST(SplitPart, HalvesMeetAndAreTheWhole) {
  std::mt19937 random(3);  // NOLINT(cert-msc51-cpp): the same fans in each run
  for (int run = 0; run < 50; ++run) {
    std::vector<GlobeVertex> vertices;
    const auto add = [&](std::int64_t x, std::int64_t y) {
      vertices.push_back({{x, y}, static_cast<double>(random() % 1000)});
    };
    add(static_cast<std::int64_t>(random() % 3) * 1000 - 1000, 77);
    GlobePart part;
    const std::array<std::array<std::int64_t, 2>, 8> ring = {{{5000, 0},
                                                              {4000, 4000},
                                                              {0, 5003},
                                                              {-4000, 4001},
                                                              {-5000, 3},
                                                              {-4000, -4000},
                                                              {0, -5001},
                                                              {4000, -4007}}};
    for (const auto& [x, y] : ring) add(x + (run % 2 == 0 ? 0 : random() % 500), y);
    for (std::uint32_t k = 0; k < 8; ++k) part.triangles.push_back({0, k + 1, (k + 1) % 8 + 1});
    const Int128 whole = AreaOf(part, vertices);
    const auto [low, high] = SplitPart(part, Axis::kX, 0, vertices);
    // Cut points are rounded to the lattice: areas move by a step times the line's length.
    const Int128 off = AreaOf(low, vertices) + AreaOf(high, vertices) - whole;
    EXPECT_LT(off < 0 ? -off : off, Int128{20000});
    EXPECT_EQ(OnLine(low, vertices, 0), OnLine(high, vertices, 0));
    for (const auto& t : low.triangles) {
      for (const std::uint32_t v : t) EXPECT_LE(vertices[v].place.x, 0);
    }
    for (const auto& t : high.triangles) {
      for (const std::uint32_t v : t) EXPECT_GE(vertices[v].place.x, 0);
    }
  }
}

TEST(SplitPart, ACutLiesOnTheEdgeWhicheverWayItRuns) {
  std::vector<GlobeVertex> vertices = {{{-300, 0}, 10}, {{700, 100}, 60}, {{700, -1000}, 0}};
  const auto one = SplitPart({{{0, 2, 1}}, {}}, Axis::kX, 0, vertices);
  std::vector<GlobeVertex> turned = {vertices[1], vertices[0], vertices[2]};
  const auto other = SplitPart({{{2, 0, 1}}, {}}, Axis::kX, 0, turned);
  const auto find = [](const std::vector<GlobeVertex>& in) {
    return std::find_if(in.begin() + 3, in.end(), [](const auto& v) { return v.place.y == 30; });
  };
  ASSERT_NE(find(vertices), vertices.end());
  ASSERT_NE(find(turned), turned.end());
  EXPECT_DOUBLE_EQ(find(vertices)->height_m, 25);
  EXPECT_EQ(find(vertices)->height_m, find(turned)->height_m);
  EXPECT_EQ(find(vertices)->normal, find(turned)->normal);
}

TEST(SplitPart, AWallOnTheLineGoesWithItsGround) {
  std::vector<GlobeVertex> vertices = {{{0, 0}, 9}, {{0, 100}, 9}, {{0, 100}, 0}, {{0, 0}, 0}};
  const auto to_north = SplitPart({{}, {{0, 1, 2, 3}}}, Axis::kX, 0, vertices);
  EXPECT_EQ(to_north[0].walls.size(), 1U);  // ground to the left: in the west
  const auto to_south = SplitPart({{}, {{1, 0, 3, 2}}}, Axis::kX, 0, vertices);
  EXPECT_EQ(to_south[1].walls.size(), 1U);
}

TEST(SplitPart, AWallAcrossIsCutWithItsGround) {
  std::vector<GlobeVertex> vertices = {{{-50, 0}, 10}, {{50, 0}, 30}, {{50, 0}, 0}, {{-50, 0}, 0}};
  vertices[2].is_ground = vertices[3].is_ground = false;
  const auto halves = SplitPart({{}, {{0, 1, 2, 3}}}, Axis::kX, 0, vertices);
  ASSERT_EQ(halves[0].walls.size(), 1U);
  ASSERT_EQ(halves[1].walls.size(), 1U);
  const auto& west = halves[0].walls.front();
  EXPECT_EQ(west[1], halves[1].walls.front()[0]);
  EXPECT_EQ(vertices[west[1]].height_m, 20);
  EXPECT_EQ(vertices[west[2]].height_m, 0);
  EXPECT_FALSE(vertices[west[2]].is_ground);
}

}  // namespace
}  // namespace farhorizon

#include "core/terrain/terrain.h"

#include <array>
#include <map>
#include <random>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/geometry/plan.h"

namespace farhorizon {
namespace {

Dem DemOfHeights(std::int32_t columns, std::int32_t rows, std::vector<std::int32_t> heights) {
  Dem dem;
  dem.columns = columns;
  dem.rows = rows;
  dem.heights = std::move(heights);
  return dem;
}

Dem RandomDemWithHoles(std::int32_t columns, std::int32_t rows, std::mt19937& random) {
  std::vector<std::int32_t> heights(static_cast<std::size_t>(columns * rows));
  for (std::int32_t& h : heights) {
    h = random() % 4 == 0 ? kNoHeight : static_cast<std::int32_t>(random() % 10);
  }
  return DemOfHeights(columns, rows, heights);
}

// The slow twin: sides of triangles, gathered from the cells.
std::map<std::pair<VertexId, VertexId>, VertexId> SidesOfTriangles(const Terrain& terrain) {
  std::map<std::pair<VertexId, VertexId>, VertexId> sides;
  for (const Triangle& t : terrain.Triangles()) {
    for (std::size_t k = 0; k < 3; ++k) sides[{t[k], t[(k + 1) % 3]}] = t[(k + 2) % 3];
  }
  return sides;
}

TEST(Terrain, ACellOfFourPostsIsSplitFromItsFirstCornerToItsLast) {
  const Dem dem = DemOfHeights(2, 2, {0, 0, 0, 0});
  const Terrain terrain = *Terrain::Build(dem);
  EXPECT_EQ(terrain.Edges(), (std::vector<Edge>{{0, 1}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}));
}

TEST(Terrain, ACellWithOnePostMissingKeepsTheTriangleOfTheOtherThree) {
  const Dem dem = DemOfHeights(2, 2, {kNoHeight, 0, 0, 0});
  const Terrain terrain = *Terrain::Build(dem);
  EXPECT_EQ(terrain.Edges(), (std::vector<Edge>{{1, 2}, {1, 3}, {2, 3}}));
}

TEST(Terrain, TwoPostsMakeNoSurface) {
  const Dem dem = DemOfHeights(2, 2, {kNoHeight, 0, 0, kNoHeight});
  Result<Terrain> terrain = Terrain::Build(dem);
  ASSERT_FALSE(terrain);
  EXPECT_EQ(terrain.error().kind, "no-surface");
}

TEST(Terrain, NeighboursEdgesAndFacesAreThoseOfTheTriangles) {
  std::mt19937 random(7);
  for (int round = 0; round < 500; ++round) {
    const Dem dem = RandomDemWithHoles(2 + static_cast<std::int32_t>(random() % 5),
                                       2 + static_cast<std::int32_t>(random() % 5), random);
    Result<Terrain> built = Terrain::Build(dem);
    if (!built) continue;
    const Terrain& terrain = *built;
    const auto sides = SidesOfTriangles(terrain);
    std::set<Edge> expected;
    for (const auto& [side, third] : sides) expected.insert(MakeEdge(side.first, side.second));
    const std::vector<Edge> edges = terrain.Edges();
    ASSERT_THAT(edges, testing::ElementsAreArray(expected)) << "round " << round;
    ASSERT_EQ(terrain.CountEdges(), static_cast<std::int64_t>(edges.size()));
    for (const Edge edge : edges) {
      const Terrain::Faces faces = terrain.FacesOf(edge);
      const auto left = sides.find({edge.a, edge.b});
      const auto right = sides.find({edge.b, edge.a});
      ASSERT_EQ(faces.left.has_value(), left != sides.end());
      ASSERT_EQ(faces.right.has_value(), right != sides.end());
      if (faces.left) {
        ASSERT_EQ(*faces.left, left->second);
      }
      if (faces.right) {
        ASSERT_EQ(*faces.right, right->second);
      }
    }
  }
}

TEST(Terrain, TrianglesRunCounterClockwiseSeenFromAbove) {
  const Dem dem = DemOfHeights(3, 3, {0, 1, 2, 3, kNoHeight, 5, 6, 7, 8});
  const Terrain terrain = *Terrain::Build(dem);
  for (const Triangle& t : terrain.Triangles()) {
    const Point3i a = terrain.Point(t[0]);
    const Point3i b = terrain.Point(t[1]);
    const Point3i c = terrain.Point(t[2]);
    EXPECT_GT((b.x - a.x) * (a.y - c.y) - (a.y - b.y) * (c.x - a.x), 0);
  }
}

// RidgeSign by the height of d over the plane through a, b, c.
int RidgeSignByPlane(Point3i a, Point3i b, Point3i c, Point3i d) {
  const auto minor = [](std::int64_t p, std::int64_t q, std::int64_t r, std::int64_t s) {
    return p * s - q * r;
  };
  const Point3i u{b.x - a.x, b.y - a.y, b.z - a.z};
  const Point3i v{c.x - a.x, c.y - a.y, c.z - a.z};
  const Point3i w{d.x - a.x, d.y - a.y, d.z - a.z};
  const std::int64_t plan = minor(u.x, u.y, v.x, v.y);
  const std::int64_t above =
      w.x * minor(u.y, u.z, v.y, v.z) - w.y * minor(u.x, u.z, v.x, v.z) + w.z * plan;  // times plan
  return above == 0 ? 0 : ((above > 0) == (plan > 0) ? -1 : 1);
}

TEST(RidgeSign, IsThatOfTheHeightsAcrossTheDiagonal) {
  // Across a parallelogram the test is z_a + z_b against z_c + z_d.
  for (int za = 0; za < 3; ++za) {
    for (int zc = 0; zc < 3; ++zc) {
      const int sign = RidgeSign({0, 0, za}, {1, 1, 1}, {1, 0, zc}, {0, 1, 1});
      const int expected = za + 1 - zc - 1;
      EXPECT_EQ(sign, expected > 0 ? 1 : (expected < 0 ? -1 : 0));
    }
  }
}

TEST(Terrain, ARidgeIsAnEdgeWhoseFacesBendDownwards) {
  std::mt19937 random(8);
  std::array<int, 3> signs{};
  for (int round = 0; round < 300; ++round) {
    const Dem dem = RandomDemWithHoles(2 + static_cast<std::int32_t>(random() % 5),
                                       2 + static_cast<std::int32_t>(random() % 5), random);
    Result<Terrain> built = Terrain::Build(dem);
    if (!built) continue;
    const Terrain& terrain = *built;
    for (const Edge edge : terrain.Edges()) {
      const Terrain::Faces faces = terrain.FacesOf(edge);
      if (!faces.left || !faces.right) {
        EXPECT_TRUE(terrain.IsRidgeOrBorder(edge));
        continue;
      }
      const int sign = RidgeSignByPlane(terrain.Point(edge.a), terrain.Point(edge.b),
                                        terrain.Point(*faces.left), terrain.Point(*faces.right));
      ASSERT_EQ(terrain.IsRidgeOrBorder(edge), sign > 0);
      ++signs[static_cast<std::size_t>(sign + 1)];
    }
  }
  for (const int count : signs) EXPECT_GT(count, 100);
}

}  // namespace
}  // namespace farhorizon

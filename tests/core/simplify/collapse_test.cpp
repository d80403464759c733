#include "core/simplify/collapse.h"

#include <gtest/gtest.h>

#include "tests/support/drawn_dem.h"
#include "tests/support/mesh_checks.h"

namespace farhorizon {
namespace {

CollapseRules Within(const Dem& dem, double vertical_error) {
  CollapseRules rules;
  rules.limits.vertical_error = vertical_error;
  rules.removable.assign(dem.heights.size(), true);
  return rules;
}

TEST(Collapser, ReducesAPlaneToTwoTriangles) {
  const Dem dem = DemOf(17, 9, [](int c, int r) { return 3 * c - 2 * r; });
  const Terrain terrain = *Terrain::Build(dem);
  Collapser collapser(terrain);
  ASSERT_TRUE(collapser.Run(Within(dem, 0), {}, {}));
  EXPECT_EQ(collapser.surface().triangle_count(), 2);
  EXPECT_EQ(FaultOfCover(terrain, collapser.surface().Triangles()), "");
}

TEST(Collapser, KeepsTheLoneSummit) {
  const Dem dem = DemOf(9, 9, [](int c, int r) { return c == 4 && r == 4 ? 9 : 0; });
  const Terrain terrain = *Terrain::Build(dem);
  Collapser collapser(terrain);
  ASSERT_TRUE(collapser.Run(Within(dem, 0), {}, {}));
  EXPECT_TRUE(collapser.surface().IsVertex(4 * 9 + 4));
  EXPECT_EQ(GreatestVerticalError(terrain, collapser.surface().Triangles()), 0);
}

TEST(Collapser, StaysWithinItsErrorAtEveryPostAndCoversTheDomain) {
  for (std::uint32_t seed = 0; seed < 6; ++seed) {
    const Dem dem = WithHoles(FractalDem(5, seed), static_cast<int>(seed), seed);
    const Terrain terrain = *Terrain::Build(dem);
    Collapser collapser(terrain);
    std::int64_t before = collapser.surface().triangle_count();
    for (const double error : {0.0, 5.0, 20.0, 80.0}) {
      ASSERT_TRUE(collapser.Run(Within(dem, error), {}, {}));
      const std::vector<Triangle> mesh = collapser.surface().Triangles();
      EXPECT_EQ(FaultOfCover(terrain, mesh), "") << "seed " << seed;
      EXPECT_LE(GreatestVerticalError(terrain, mesh), error) << "seed " << seed;
      EXPECT_LE(std::ssize(mesh), before);
      before = std::ssize(mesh);
    }
    EXPECT_LT(before, std::ssize(terrain.Triangles()) / 2);
  }
}

TEST(Collapser, KeepsToTheLimitsOnShape) {
  const Dem dem = FractalDem(5, 3);
  const Terrain terrain = *Terrain::Build(dem);
  CollapseRules rules = Within(dem, 200);
  rules.limits.longest_edge = 6;
  rules.limits.least_altitude = 0.5;
  Collapser collapser(terrain);
  ASSERT_TRUE(collapser.Run(rules, {}, {}));
  double longest = 0;
  double least_altitude = 100;
  for (const Triangle& t : collapser.surface().Triangles()) {
    double side = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Point3i p = terrain.Point(t[k]);
      const Point3i q = terrain.Point(t[(k + 1) % 3]);
      side = std::max(side, std::hypot(q.x - p.x, q.y - p.y));
    }
    const Point3i a = terrain.Point(t[0]);
    const Point3i b = terrain.Point(t[1]);
    const Point3i c = terrain.Point(t[2]);
    const double area = std::abs((b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y));
    longest = std::max(longest, side);
    least_altitude = std::min(least_altitude, area / side);
  }
  EXPECT_LE(longest, 6.0);
  EXPECT_GT(longest, 4.0);  // the limit is what holds it
  EXPECT_GE(least_altitude, 0.5 - 1e-12);
}

TEST(Collapser, KeepsPostsThatAreNotRemovableAndEdgesBetweenThem) {
  const Dem dem = FractalDem(5, 4);
  const Terrain terrain = *Terrain::Build(dem);
  CollapseRules rules = Within(dem, 1000);
  std::vector<Edge> held;
  for (VertexId v = 33 * 16; v < 33 * 17 - 1; ++v) {
    held.push_back({v, v + 1});
    rules.removable[static_cast<std::size_t>(v)] = false;
    rules.removable[static_cast<std::size_t>(v + 1)] = false;
  }
  Collapser collapser(terrain);
  ASSERT_TRUE(collapser.Run(rules, {}, {}));
  std::set<Edge> edges;
  for (const Triangle& t : collapser.surface().Triangles()) {
    for (std::size_t k = 0; k < 3; ++k) edges.insert(MakeEdge(t[k], t[(k + 1) % 3]));
  }
  for (const Edge& edge : held) EXPECT_EQ(edges.count(edge), 1U);
}

TEST(Collapser, AsksForNoEdgeBelowTheSurface) {
  const Dem dem =
      DemOf(17, 17, [](int c, int r) { return -(c - 8) * (c - 8) - (r - 8) * (r - 8); });
  const Terrain terrain = *Terrain::Build(dem);
  CollapseRules rules = Within(dem, 10);
  rules.may_add_edge = [](VertexId, VertexId) { return false; };
  Collapser collapser(terrain);
  ASSERT_TRUE(collapser.Run(rules, {}, {}));
  EXPECT_LT(collapser.surface().triangle_count(), 300);
}

TEST(Collapser, KeepsABowlWhereNoEdgeAboveTheSurfaceIsAllowed) {
  const Dem dem = DemOf(17, 17, [](int c, int r) { return (c - 8) * (c - 8) + (r - 8) * (r - 8); });
  const Terrain terrain = *Terrain::Build(dem);
  CollapseRules rules = Within(dem, 10);
  rules.may_add_edge = [](VertexId, VertexId) { return false; };
  Collapser collapser(terrain);
  ASSERT_TRUE(collapser.Run(rules, {}, {}));
  EXPECT_EQ(collapser.surface().triangle_count(), 512);
}

TEST(Collapser, AsksForEveryEdgeAboveTheSurface) {
  const Dem dem = FractalDem(4, 5);
  const Terrain terrain = *Terrain::Build(dem);
  CollapseRules rules = Within(dem, 1000);
  std::set<Edge> refused;
  // Edges above the surface are allowed between even posts only.
  rules.may_add_edge = [&refused](VertexId p, VertexId q) {
    const bool may = p % 2 == 0 && q % 2 == 0;
    if (!may) refused.insert(MakeEdge(p, q));
    return may;
  };
  Collapser collapser(terrain);
  ASSERT_TRUE(collapser.Run(rules, {}, {}));
  EXPECT_GT(refused.size(), 0U);
  EXPECT_LT(collapser.surface().triangle_count(), std::ssize(terrain.Triangles()));
}

TEST(Collapser, StopsWhenAStopIsRequested) {
  const Dem dem = FractalDem(4, 6);
  const Terrain terrain = *Terrain::Build(dem);
  std::stop_source source;
  source.request_stop();
  Collapser collapser(terrain);
  Status status = collapser.Run(Within(dem, 10), {.stop = source.get_token()}, {});
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::kCancelled);
}

}  // namespace
}  // namespace farhorizon

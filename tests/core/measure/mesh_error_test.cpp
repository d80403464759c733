#include "core/measure/mesh_error.h"

#include <gtest/gtest.h>

#include "core/horizon/find_horizon.h"
#include "core/simplify/lod_chain.h"
#include "tests/support/drawn_dem.h"
#include "tests/support/line_heights.h"
#include "tests/support/mesh_checks.h"

namespace farhorizon {
namespace {

struct Measured {
  GridMesh mesh;
  std::vector<VertexId> posts;
};

Measured OnPosts(const Terrain& terrain, const std::vector<Triangle>& triangles) {
  Measured measured;
  std::map<VertexId, std::int32_t> index;
  for (const Triangle& t : triangles) {
    std::array<std::int32_t, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [at, is_new] = index.try_emplace(t[k], std::ssize(measured.posts));
      if (is_new) {
        measured.posts.push_back(t[k]);
        measured.mesh.points.push_back({static_cast<double>(terrain.dem().Column(t[k])),
                                        static_cast<double>(terrain.dem().Row(t[k])),
                                        terrain.dem().HeightM(t[k])});
      }
      corners[k] = at->second;
    }
    measured.mesh.triangles.push_back(corners);
  }
  return measured;
}

Result<MeshError> Measure(const Terrain& terrain, const Measured& m, double asked_m = 1) {
  const Horizon horizon = *FindHorizon(terrain, {}, {});
  return MeasureMeshError(terrain, horizon, m.mesh, m.posts, asked_m, {});
}

TEST(MeshError, IsZeroForTheTerrainItself) {
  Dem dem = WithHoles(FractalDem(4, 1), 2, 1);
  dem.quantum_m = 0.25;
  dem.height_offset_m = 100;
  const Terrain terrain = *Terrain::Build(dem);
  Result<MeshError> error = Measure(terrain, OnPosts(terrain, terrain.Triangles()));
  ASSERT_TRUE(error);
  EXPECT_EQ(error->vertical.max_m, 0);
  EXPECT_EQ(error->vertical.rms_m, 0);
  EXPECT_EQ(error->silhouette.max_m, 0);
  EXPECT_EQ(error->silhouette.rms_m, 0);
}

TEST(MeshError, OfEveryLevelIsWithinItsBudgetsAndNotBelowTheErrorOnAnyLine) {
  const Dem dem = FractalDem(5, 2);
  const Terrain terrain = *Terrain::Build(dem);
  const Horizon horizon = *FindHorizon(terrain, {}, {});
  const std::vector<LevelBudget> budgets = {{10, 0, 0, 0}, {20, 2.5, 0, 0}, {80, 10, 0, 0}};
  const std::vector<Lod> levels = *BuildLodChain(terrain, horizon, budgets, {});
  const std::vector<Triangle> full = terrain.Triangles();
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const std::vector<Triangle>& mesh = levels[i].mesh.triangles;
    const Measured m = OnPosts(terrain, mesh);
    Result<MeshError> error =
        MeasureMeshError(terrain, horizon, m.mesh, m.posts, budgets[i].silhouette_error_m, {});
    ASSERT_TRUE(error);
    EXPECT_NEAR(error->vertical.max_m, GreatestVerticalError(terrain, mesh), 1e-9);
    EXPECT_LE(error->silhouette.max_m, budgets[i].silhouette_error_m);
    EXPECT_LE(error->silhouette.rms_m, error->silhouette.max_m + 1e-9);
    std::mt19937 random(3);
    for (int n = 0; n < 1000; ++n) {
      const RationalLine line = RandomLine(dem, random);
      const double wanted = HeightOverLine(terrain, full, line);
      if (std::isinf(wanted)) continue;
      EXPECT_LE(std::abs(wanted - HeightOverLine(terrain, mesh, line)),
                error->silhouette.max_m + 1e-6);
    }
  }
}

TEST(MeshError, IsTheHeightOfASummitThatIsRemoved) {
  const Dem dem = DemOf(9, 9, [](int c, int r) { return c == 4 && r == 4 ? 100 : 0; });
  const Dem flat = DemOf(9, 9, [](int, int) { return 0; });
  const Terrain terrain = *Terrain::Build(dem);
  // Two triangles over the whole: the summit is gone.
  Result<MeshError> error = Measure(terrain, OnPosts(terrain, {{0, 80, 8}, {0, 72, 80}}), 3);
  ASSERT_TRUE(error);
  EXPECT_EQ(error->vertical.max_m, 100);
  EXPECT_NEAR(error->vertical.rms_m, 100.0 / 9, 1e-9);
  EXPECT_GE(error->silhouette.max_m, 100);
  EXPECT_LE(error->silhouette.max_m, 105);
  EXPECT_GT(error->silhouette.rms_m, 0);
}

TEST(MeshError, IncludesTheEffectOfMovedVertices) {
  const Dem dem = DemOf(9, 9, [](int c, int r) { return 10 * c + r; });
  const Terrain terrain = *Terrain::Build(dem);
  Measured m = OnPosts(terrain, terrain.Triangles());
  for (GridPoint& p : m.mesh.points) {
    p.column += 0.01;
    p.height_m += 0.5;
  }
  Result<MeshError> error = Measure(terrain, m);
  ASSERT_TRUE(error);
  // Heights are half a metre up, and a hundredth of a cell of a slope of ten to the side.
  EXPECT_NEAR(error->vertical.max_m, 0.5, 1e-9);
  EXPECT_NEAR(error->silhouette.max_m, 0.5 + 0.01 * 10, 1e-9);
  EXPECT_LE(error->silhouette.rms_m, error->silhouette.max_m);
  EXPECT_GE(error->silhouette.rms_m, 0.3);
}

TEST(MeshError, RefusesAMeshThatDoesNotCoverTheDomain) {
  const Dem dem = FractalDem(3, 4);
  const Terrain terrain = *Terrain::Build(dem);
  const std::vector<Triangle> full = terrain.Triangles();

  std::vector<Triangle> holed(full.begin() + 1, full.end());
  Result<MeshError> hole = Measure(terrain, OnPosts(terrain, holed));
  ASSERT_FALSE(hole);
  EXPECT_EQ(hole.error().kind, "hole");

  std::vector<Triangle> flipped = full;
  std::swap(flipped[5][0], flipped[5][1]);
  Result<MeshError> flip = Measure(terrain, OnPosts(terrain, flipped));
  ASSERT_FALSE(flip);
  EXPECT_EQ(flip.error().kind, "flipped-triangle");

  Measured away = OnPosts(terrain, full);
  away.mesh.points[7].row += 0.6;
  Result<MeshError> moved = Measure(terrain, away);
  ASSERT_FALSE(moved);
  EXPECT_EQ(moved.error().kind, "displaced-vertex");
}

}  // namespace
}  // namespace farhorizon

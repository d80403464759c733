#include "core/measure/mesh_error.h"

#include <numbers>

#include <gtest/gtest.h>

#include "core/horizon/find_horizon.h"
#include "tests/support/drawn_dem.h"
#include "tests/support/effort.h"
#include "tests/support/measured_meshes.h"

namespace farhorizon {
namespace {

MeshError MeasuredOn(const Terrain& terrain, const GridMesh& mesh) {
  const Horizon horizon = *FindHorizon(terrain, {}, {});
  Result<MeshError> error = MeshMeasurer(terrain, horizon, {}).Measure({mesh, {}}, {});
  EXPECT_TRUE(error) << error.error().message;
  return error ? *error : MeshError{};
}

// Whether a line turns by less than kGrazingAngle, or little more, from a direction of the grid.
bool Grazes(const MeshLine& line) {
  const double turn = std::atan2(line.dy, line.dx) / (std::numbers::pi / 4);
  return std::abs(turn - std::round(turn)) * (std::numbers::pi / 4) < 1.1 * kGrazingAngle;
}

// Compares what `error` says with both surfaces over one line.
void ExpectBounds(const GridMesh& ground, const GridMesh& mesh, const MeshError& error,
                  const MeshLine& line) {
  if (Grazes(line)) return;
  const Highest of_ground = HighestOver(ground, line);
  const Highest of_mesh = HighestOver(mesh, line);
  if (!of_ground.meets() || !of_mesh.meets()) return;
  const double off = std::abs(of_ground.height() - of_mesh.height());
  const bool ground_higher = of_ground.height() > of_mesh.height();
  const Highest& higher = ground_higher ? of_ground : of_mesh;
  const bool inside =
      HeightIn(ground_higher ? mesh : ground, higher.at.column, higher.at.row).has_value();
  const bool inner = higher.inner > higher.outline && inside;
  ASSERT_LE(off, (inner ? error.silhouette.max_m : error.rim_m) + 1e-6)
      << "line through " << line.x << " " << line.y << " along " << line.dx << " " << line.dy;
}

// Lines through pairs of points of both surfaces, on them and close beside them, and any others.
void ExpectBoundsOnLines(const GridMesh& ground, const GridMesh& mesh, const MeshError& error,
                         std::mt19937& random, int lines) {
  const auto any = [&random](const GridMesh& of) {
    const auto& t = of.triangles[random() % of.triangles.size()];
    return of.points[static_cast<std::size_t>(t[random() % 3])];
  };
  for (int n = 0; n < lines && !testing::Test::HasFatalFailure(); ++n) {
    const GridPoint p = any(random() % 2 == 0 ? ground : mesh);
    const GridPoint q = any(random() % 2 == 0 ? ground : mesh);
    MeshLine line{p.column, p.row, q.column - p.column, q.row - p.row};
    const double beside = random() % 3 == 0 ? 0 : random() % 2 == 0 ? 1e-7 : 0.3;
    line.x += beside * (static_cast<double>(random()) / 2147483648.0 - 1.0);
    line.dy += beside * (static_cast<double>(random()) / 2147483648.0 - 1.0);
    if (line.dx == 0 && line.dy == 0) continue;
    ExpectBounds(ground, mesh, error, line);
  }
}

TEST(MeshError, IsZeroForTheTerrainItself) {
  Dem dem = WithHoles(FractalDem(4, 1), 2, 1);
  dem.quantum_m = 0.25;
  dem.height_offset_m = 100;
  const Terrain terrain = *Terrain::Build(dem);
  const MeshError error = MeasuredOn(terrain, MeshOf(terrain));
  EXPECT_NEAR(error.vertical.max_m, 0, 1e-9);
  EXPECT_NEAR(error.vertical.rms_m, 0, 1e-9);
  EXPECT_NEAR(error.silhouette.max_m, 0, 1e-4);
  EXPECT_NEAR(error.silhouette.rms_m, 0, 1e-9);
  EXPECT_NEAR(error.rim_m, 0, 1e-4);
  EXPECT_NEAR(error.facet_angle_rms_deg, 0, 1e-6);
  EXPECT_EQ(error.covered_share, 1);
  EXPECT_EQ(error.defects.flipped + error.defects.crowded_edges + error.defects.open_edges +
                error.defects.covered_twice,
            0);
}

TEST(MeshError, IsTheHeightOfASummitThatIsRemoved) {
  const Dem dem = DemOf(9, 9, [](int c, int r) { return c == 4 && r == 4 ? 100 : 0; });
  const Terrain terrain = *Terrain::Build(dem);
  const GridMesh flat = {{{0, 0, 0}, {8, 0, 0}, {0, 8, 0}, {8, 8, 0}}, {{0, 3, 1}, {0, 2, 3}}};
  const MeshError error = MeasuredOn(terrain, flat);
  EXPECT_EQ(error.vertical.max_m, 100);
  EXPECT_NEAR(error.vertical.rms_m, 100.0 / 9, 1e-9);
  EXPECT_GE(error.silhouette.max_m, 100);
  EXPECT_LE(error.silhouette.max_m, 103);
  EXPECT_GT(error.silhouette.rms_m, 0);
  EXPECT_LE(error.sampled_max_m, 100);
}

TEST(MeshError, IsWhatAMeshThatBridgesAValleyRaises) {
  // Two ridges with a valley between: over the floor the mesh is at the ridges' height.
  const Dem dem = DemOf(41, 9, [](int, int r) { return r == 2 || r == 6 ? 50 : 0; });
  const Terrain terrain = *Terrain::Build(dem);
  GridMesh mesh = MeshOf(terrain);
  for (GridPoint& p : mesh.points) {
    if (p.row > 2 && p.row < 6) p.height_m = 50;
  }
  const MeshError error = MeasuredOn(terrain, mesh);
  EXPECT_NEAR(error.silhouette.max_m, 50, 1.5);
  EXPECT_LE(error.silhouette.max_m, 50 * 1.03);
}

TEST(MeshError, IncludesTheEffectOfMovedVertices) {
  const Dem dem = DemOf(33, 33, [](int c, int r) { return 10 * c + (r % 4 == 2 ? 40 : 0); });
  const Terrain terrain = *Terrain::Build(dem);
  GridMesh mesh = MeshOf(terrain);
  for (GridPoint& p : mesh.points) {
    p.column += 0.01;
    p.height_m += 0.5;
  }
  const MeshError error = MeasuredOn(terrain, mesh);
  EXPECT_NEAR(error.vertical.max_m, 0.5, 0.11);
  EXPECT_GE(error.silhouette.max_m, 0.3);
  EXPECT_LE(error.silhouette.max_m, (0.5 + 0.01 * 10) * 1.03);
  EXPECT_GE(error.rim_m, error.silhouette.max_m);
}

TEST(MeshError, IsNowhereBelowTheErrorOnALine) {
  std::mt19937 random(7);
  for (int round = 0; round < Rounds(120); ++round) {
    const auto columns = static_cast<std::int32_t>(2 + random() % 10);
    const auto rows = static_cast<std::int32_t>(2 + random() % 10);
    // Noise, steps, cliffs, ramps.
    const auto kind = random() % 4;
    const Dem dem = DemOf(columns, rows, [&](int c, int r) {
      const auto noise = static_cast<int>(random() % 30);
      return kind == 0   ? noise
             : kind == 1 ? noise / 10
             : kind == 2 ? (c > r ? 1000 : noise)
                         : 20 * c - 7 * r + noise / 5;
    });
    const Terrain terrain = *Terrain::Build(dem);
    const GridMesh ground = MeshOf(terrain);
    GridMesh mesh = random() % 4 == 0 ? ground : CoarseMesh(dem, random);
    Shake(mesh, random() % 2 == 0 ? 0 : 0.02, random() % 2 == 0 ? 0 : 3, random);
    const MeshError error = MeasuredOn(terrain, mesh);
    ExpectBoundsOnLines(ground, mesh, error, random, 150);
    if (HasFatalFailure()) FAIL() << "round " << round << ", kind " << kind;
    EXPECT_LE(error.sampled_max_m, error.silhouette.max_m + 1e-6);
    EXPECT_LE(error.sampled_rim_m, std::max(error.rim_m, error.silhouette.max_m) + 1e-6);
  }
}

TEST(MeshError, IsNowhereBelowTheErrorOnALineBesideHoles) {
  std::mt19937 random(11);
  for (int round = 0; round < Rounds(40); ++round) {
    const Dem dem = WithHoles(FractalDem(3, static_cast<std::uint32_t>(round), 60), 3,
                              static_cast<std::uint32_t>(round));
    Result<Terrain> terrain = Terrain::Build(dem);
    if (!terrain) continue;
    const GridMesh ground = MeshOf(*terrain);
    GridMesh mesh = ground;
    Shake(mesh, 0.02, 4, random);
    const MeshError error = MeasuredOn(*terrain, mesh);
    ExpectBoundsOnLines(ground, mesh, error, random, 150);
    if (HasFatalFailure()) FAIL() << "round " << round;
  }
}

TEST(MeshError, IsNoMoreThanTheReliefWhereAHoleTearsTheGround) {
  // Lines meet a corner of one half, miss the mesh there, and pass between both halves.
  Dem dem = DemOf(12, 12, [](int c, int r) { return 10 + (3 * c + 5 * r) % 7; });
  for (std::size_t c = 0; c < 12; ++c) dem.heights[6 * 12 + c] = kNoHeight;
  const Terrain terrain = *Terrain::Build(dem);
  const GridMesh ground = MeshOf(terrain);
  GridMesh mesh = ground;
  for (GridPoint& p : mesh.points) p.column = 5.5 + (p.column - 5.5) * 0.995;
  const MeshError error = MeasuredOn(terrain, mesh);
  EXPECT_GT(error.rim_m, 0);
  EXPECT_LE(error.rim_m, 7);
  std::mt19937 random(5);
  ExpectBoundsOnLines(ground, mesh, error, random, 500);
}

TEST(MeshError, IsTightOnRoughGround) {
  const Dem dem = FractalDem(6, 5);
  const Terrain terrain = *Terrain::Build(dem);
  std::mt19937 random(2);
  GridMesh mesh = CoarseMesh(dem, random);
  Shake(mesh, 0, 20, random);
  const MeshError error = MeasuredOn(terrain, mesh);
  // What some line attains is in the sample or found by the search.
  EXPECT_LE(error.silhouette.max_m, 1.5 * std::max(error.sampled_max_m, error.sampled_rim_m));
  EXPECT_GE(error.silhouette.max_m, error.sampled_max_m);
}

TEST(MeshError, OfAMeshThatCoversAPartIsMeasuredThere) {
  const Dem dem = FractalDem(4, 9);
  const Terrain terrain = *Terrain::Build(dem);
  GridMesh mesh = MeshOf(terrain);
  std::erase_if(mesh.triangles, [&](const auto& t) {
    return mesh.points[static_cast<std::size_t>(t[0])].column > 8 ||
           mesh.points[static_cast<std::size_t>(t[1])].column > 8 ||
           mesh.points[static_cast<std::size_t>(t[2])].column > 8;
  });
  const MeshError error = MeasuredOn(terrain, mesh);
  EXPECT_NEAR(error.vertical.max_m, 0, 1e-9);
  EXPECT_NEAR(error.covered_share, 9.0 / 17, 1e-12);
  EXPECT_GT(error.silhouette.rms_m, 0);
  std::mt19937 random(4);
  ExpectBoundsOnLines(MeshOf(terrain), mesh, error, random, 300);
}

TEST(MeshError, ReportsWhatIsWrongWithAMesh) {
  const Dem dem = FractalDem(3, 4);
  const Terrain terrain = *Terrain::Build(dem);
  GridMesh mesh = MeshOf(terrain);
  std::swap(mesh.triangles[20][0], mesh.triangles[20][1]);
  mesh.triangles.push_back(mesh.triangles[50]);
  mesh.triangles.erase(mesh.triangles.begin() + 60);
  const MeshError error = MeasuredOn(terrain, mesh);
  EXPECT_EQ(error.defects.flipped, 1);
  EXPECT_GE(error.defects.crowded_edges, 3);
  EXPECT_GE(error.defects.open_edges, 3);
}

TEST(MeshError, TakesAPointForEachTriangleAsOneMesh) {
  const Dem dem = FractalDem(4, 6);
  const Terrain terrain = *Terrain::Build(dem);
  std::mt19937 random(1);
  const GridMesh mesh = CoarseMesh(dem, random);
  GridMesh soup;
  for (const auto& t : mesh.triangles) {
    const auto first = static_cast<std::int32_t>(soup.points.size());
    for (const std::int32_t i : t) soup.points.push_back(mesh.points[static_cast<std::size_t>(i)]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  const MeshError whole = MeasuredOn(terrain, mesh);
  const MeshError apart = MeasuredOn(terrain, soup);
  EXPECT_EQ(apart.defects.open_edges, 0);
  EXPECT_NEAR(apart.silhouette.max_m, whole.silhouette.max_m, 0.05 * whole.silhouette.max_m);
  EXPECT_NEAR(apart.vertical.rms_m, whole.vertical.rms_m, 1e-9);
}

TEST(MeshError, RefusesWhatIsNoMeshOfTheDem) {
  const Dem dem = FractalDem(3, 4);
  const Terrain terrain = *Terrain::Build(dem);
  const Horizon horizon = *FindHorizon(terrain, {}, {});
  MeshMeasurer measurer(terrain, horizon, {});
  const auto kind_of = [&](const GridMesh& mesh) {
    Result<MeshError> error = measurer.Measure({mesh, {}}, {});
    return error ? std::string("none") : std::string(error.error().kind);
  };
  GridMesh mesh = MeshOf(terrain);
  mesh.triangles[3][1] = 1000;
  EXPECT_EQ(kind_of(mesh), "unknown-point");
  mesh = MeshOf(terrain);
  mesh.points[4].row = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(kind_of(mesh), "bad-mesh");
  mesh = MeshOf(terrain);
  for (GridPoint& p : mesh.points) p.column += 100;
  EXPECT_EQ(kind_of(mesh), "bad-mesh");
}

TEST(MeshError, StopsWhenAsked) {
  const Dem dem = FractalDem(4, 4);
  const Terrain terrain = *Terrain::Build(dem);
  const Horizon horizon = *FindHorizon(terrain, {}, {});
  std::stop_source stop;
  stop.request_stop();
  Result<MeshError> error =
      MeshMeasurer(terrain, horizon, {}).Measure({MeshOf(terrain), {}}, {.stop = stop.get_token()});
  ASSERT_FALSE(error);
  EXPECT_EQ(error.error().code, ErrorCode::kCancelled);
}

}  // namespace
}  // namespace farhorizon

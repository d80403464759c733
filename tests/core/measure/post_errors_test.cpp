#include "core/measure/post_errors.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/drawn_dem.h"
#include "tests/support/effort.h"
#include "tests/support/measured_meshes.h"

namespace farhorizon {
namespace {

constexpr double kRadius = 6'371'000;

// A globe without flattening, the frame's origin on its surface at the grid's middle; columns run
// along a parallel, rows along a meridian.
struct Globe {
  double column_rad;
  double row_rad;
  double latitude_rad;
  double middle_column;
  double middle_row;

  [[nodiscard]] StraightPoint Place(const GridPoint& p) const {
    const double lon = (p.column - middle_column) * column_rad;
    const double lat = latitude_rad - (p.row - middle_row) * row_rad;
    const double r = kRadius + p.height_m;
    const double x = r * std::cos(lat) * std::sin(lon);
    const double y = r * std::sin(lat);
    const double z = r * std::cos(lat) * std::cos(lon);
    const double s = std::sin(latitude_rad);
    const double c = std::cos(latitude_rad);
    return {x, y * c - z * s, y * s + z * c - kRadius};
  }
  [[nodiscard]] PostPlaces Places(const Dem& dem) const {
    PostPlaces places;
    for (VertexId v = 0; v < dem.columns * dem.rows; ++v) {
      places.positions.push_back(
          Place({static_cast<double>(dem.Column(v)), static_cast<double>(dem.Row(v)),
                 dem.HasData(v) ? dem.HeightM(v) : 0}));
    }
    places.up = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    places.up_at_origin = {0, 0, kRadius};
    return places;
  }
};

PlacedMesh Placed(const GridMesh& mesh, const Globe& globe) {
  PlacedMesh placed{mesh, {}};
  for (const GridPoint& p : mesh.points) placed.straight.push_back(globe.Place(p));
  return placed;
}

PostErrors Measured(const Terrain& terrain, const PostPlaces& places, const PlacedMesh& mesh) {
  std::vector<std::uint8_t> is_vertex;
  for (VertexId v = 0; v < terrain.post_count(); ++v) {
    is_vertex.push_back(terrain.IsVertex(v) ? 1 : 0);
  }
  Result<PostErrors> errors =
      MeasurePosts(terrain, is_vertex, places, mesh, SidesOf(mesh.grid), {});
  EXPECT_TRUE(errors);
  return errors ? *errors : PostErrors{};
}

// How far the mesh is along the vertical through post v: every triangle is asked. Negative where
// none is met.
double DistanceByDefinition(const PostPlaces& places, const PlacedMesh& mesh, std::size_t v) {
  const StraightPoint post = places.positions[v];
  StraightPoint up = {post[0], post[1], post[2] + kRadius};
  const double length = std::hypot(up[0], up[1], up[2]);
  for (double& u : up) u /= length;
  double found = -1;
  for (const auto& t : mesh.grid.triangles) {
    std::array<StraightPoint, 3> to{};
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t i = 0; i < 3; ++i) {
        to[k][i] = mesh.straight[static_cast<std::size_t>(t[k])][i] - post[i];
      }
    }
    const auto det = [&](const StraightPoint& p, const StraightPoint& q) {
      return (p[1] * q[2] - p[2] * q[1]) * up[0] + (p[2] * q[0] - p[0] * q[2]) * up[1] +
             (p[0] * q[1] - p[1] * q[0]) * up[2];
    };
    const std::array<double, 3> shares = {det(to[1], to[2]), det(to[2], to[0]), det(to[0], to[1])};
    const double whole = shares[0] + shares[1] + shares[2];
    if (std::any_of(shares.begin(), shares.end(), [&](double s) { return s * whole < 0; }))
      continue;
    double above = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      above += shares[k] / whole * (to[k][0] * up[0] + to[k][1] * up[1] + to[k][2] * up[2]);
    }
    found = std::max(found, std::abs(above));
  }
  return found;
}

TEST(PostErrors, OfALevelSeaAreWhatFlatTrianglesCutOffTheGlobe) {
  // 100 km of sea under two triangles: in the middle they are c^2 / 8 R below it.
  const Dem dem = DemOf(101, 101, [](int, int) { return 0; });
  const Terrain terrain = *Terrain::Build(dem);
  const double step = 1000 / kRadius;
  const Globe globe{step, step, 0, 50, 50};
  const GridMesh sea = {{{0, 0, 0}, {100, 0, 0}, {0, 100, 0}, {100, 100, 0}},
                        {{0, 3, 1}, {0, 2, 3}}};
  const PostErrors errors = Measured(terrain, globe.Places(dem), Placed(sea, globe));
  const double diagonal = 100'000 * std::sqrt(2.0);
  EXPECT_NEAR(errors.vertical.max_m, diagonal * diagonal / 8 / kRadius, 1);
  EXPECT_EQ(errors.covered_share, 1);
  EXPECT_NEAR(Measured(terrain, {}, {sea, {}}).vertical.max_m, 0, 1e-9);
}

TEST(PostErrors, AreThoseOfTheTriangleThatTheVerticalMeets) {
  std::mt19937 random(3);
  for (int round = 0; round < Rounds(60); ++round) {
    const Dem dem = FractalDem(4, static_cast<std::uint32_t>(round), 3000);
    const Terrain terrain = *Terrain::Build(dem);
    // Up to a degree a cell far north: sides of triangles bend by cells on the grid.
    const double step = random() % 2 == 0 ? 1e-5 : 0.01;
    const Globe globe{step, step, random() % 2 == 0 ? 0 : 1.1, 8, 8};
    GridMesh mesh = CoarseMesh(dem, random);
    Shake(mesh, 0, 100, random);
    const PostPlaces places = globe.Places(dem);
    const PlacedMesh placed = Placed(mesh, globe);
    const PostErrors errors = Measured(terrain, places, placed);
    double most = 0;
    for (std::size_t v = 0; v < places.positions.size(); ++v) {
      // A vertical at the outline may pass beside the mesh.
      const double met = DistanceByDefinition(places, placed, v);
      const double found = met >= 0 ? met : step < 0.001 ? std::abs(double{errors.rise[v]}) : 0;
      most = std::max(most, found);
    }
    EXPECT_GE(errors.vertical.max_m, most * (1 - 1e-6)) << "round " << round;
    EXPECT_LE(errors.vertical.rms_m, errors.vertical.max_m);
    if (step < 0.001) {
      EXPECT_NEAR(errors.vertical.max_m, most, 0.02 * most + 1);
    }
  }
}

TEST(PostErrors, InTheGridAreThoseByDefinition) {
  std::mt19937 random(5);
  for (int round = 0; round < Rounds(200); ++round) {
    const Dem dem = DemOf(static_cast<std::int32_t>(2 + random() % 12),
                          static_cast<std::int32_t>(2 + random() % 12),
                          [&](int, int) { return static_cast<int>(random() % 100); });
    const Terrain terrain = *Terrain::Build(dem);
    GridMesh mesh = CoarseMesh(dem, random);
    Shake(mesh, 0, 5, random);
    const PostErrors errors = Measured(terrain, {}, {mesh, {}});
    double most = 0;
    double squares = 0;
    for (VertexId v = 0; v < terrain.post_count(); ++v) {
      const std::optional<double> height = HeightIn(mesh, dem.Column(v), dem.Row(v));
      ASSERT_TRUE(height);
      const double error = *height - dem.HeightM(v);
      EXPECT_NEAR(errors.rise[static_cast<std::size_t>(v)], error, 1e-4);
      most = std::max(most, std::abs(error));
      squares += error * error;
    }
    EXPECT_NEAR(errors.vertical.max_m, most, 1e-4);
    EXPECT_NEAR(errors.vertical.rms_m, std::sqrt(squares / terrain.post_count()), 1e-4);
    EXPECT_EQ(errors.covered_share, 1);
    EXPECT_EQ(errors.covered_twice, 0);
  }
}

TEST(PostErrors, PostsBesideAMeshThatIsALittleTooSmallAreCovered) {
  const Dem dem = DemOf(9, 9, [](int c, int) { return 10 * c; });
  const Terrain terrain = *Terrain::Build(dem);
  GridMesh mesh = MeshOf(terrain);
  for (GridPoint& p : mesh.points) {
    p.column = 4 + (p.column - 4) * 0.99;
    p.row = 4 + (p.row - 4) * 0.99;
  }
  const PostErrors near = Measured(terrain, {}, {mesh, {}});
  EXPECT_EQ(near.covered_share, 1);
  EXPECT_NEAR(near.vertical.max_m, 0.4, 0.02);
  for (GridPoint& p : mesh.points) {
    p.column = 4 + (p.column - 4) * 0.8;
    p.row = 4 + (p.row - 4) * 0.8;
  }
  EXPECT_NEAR(Measured(terrain, {}, {mesh, {}}).covered_share, 49.0 / 81, 1e-12);
}

}  // namespace
}  // namespace farhorizon

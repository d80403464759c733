#include "core/pipeline/level_lattice.h"

#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/horizon/find_horizon.h"
#include "core/io/draco_mesh.h"
#include "core/pipeline/mesh_orientation.h"
#include "tests/support/drawn_dem.h"

namespace farhorizon {
namespace {

// On UTM's central meridian, where the scale is within 0.04 % of 1.
struct Placed {
  Placed(Dem with, double cell_m) : dem(std::move(with)), terrain(*Terrain::Build(dem)) {
    dem.transform = {500000, 5100000, cell_m, -cell_m};
    dem.crs = "EPSG:32610";
    georeference.emplace(*Georeference::Of(terrain, {}));
  }
  Placed(const Placed&) = delete;
  Dem dem;
  Terrain terrain;
  std::optional<Georeference> georeference;
};

double FinestStep(double cell_m, double max_error_m = 0) {
  const Placed some(DemOf(3, 3, [](int, int) { return 0; }), cell_m);
  return FinestSideStep(*some.georeference, max_error_m);
}

TEST(FinestSideStep, IsOneForCellsThatDifferByAPercentOrTwo) {
  for (const double cell_m : {0.5, 1.0, 2.0, 3.0, 5.0, 10.0, 25.0, 30.0, 30.87, 90.0, 92.6}) {
    const double step = FinestStep(cell_m);
    EXPECT_GE(step, cell_m / 350) << cell_m;
    EXPECT_LE(step, cell_m / 175) << cell_m;
    EXPECT_EQ(FinestStep(0.98 * cell_m), step) << cell_m;
    EXPECT_EQ(FinestStep(1.02 * cell_m), step) << cell_m;
  }
}

TEST(FinestSideStep, IsHalfAMetreAtMost) {
  EXPECT_EQ(FinestStep(170), 0.5);
  EXPECT_EQ(FinestStep(1000), 0.5);
}

TEST(FinestSideStep, FollowsAnErrorThatIsAskedFor) {
  EXPECT_EQ(FinestStep(30, 1000), FinestStep(30));
  EXPECT_EQ(FinestStep(30, 0.1), 1.0 / 64);  // at most a fortieth of a metre
}

TEST(StepsOfLevel, DoubleOnTheSidesUpToASixteenthOfACell) {
  const Placed some(DemOf(3, 3, [](int, int) { return 0; }), 30);
  const auto sides = [&](int number) {
    return StepsOfLevel(0.125, *some.georeference, {}, number).sides_m;
  };
  EXPECT_EQ(sides(0), 0.125);
  EXPECT_EQ(sides(1), 0.25);
  EXPECT_EQ(sides(3), 1);
  for (int number = 4; number < 12; ++number) EXPECT_EQ(sides(number), 1) << number;
}

TEST(StepsOfLevel, InsideFollowTheErrorOfTheLevel) {
  const Placed some(DemOf(3, 3, [](int, int) { return 0; }), 30);
  const auto inside = [&](bool exact, double vertical_m, double silhouette_m) {
    Lod lod;
    lod.exact = exact;
    lod.vertical_rms_m = vertical_m;
    lod.silhouette_rms_m = silhouette_m;
    return StepsOfLevel(1, *some.georeference, lod, 0).inside_m;
  };
  EXPECT_EQ(inside(true, 1, 0), 0.25);
  EXPECT_EQ(inside(true, 0.9, 0), 0.125);
  EXPECT_EQ(inside(true, 100, 0), 1);  // no coarser than the sides
  EXPECT_EQ(inside(true, 0, 0), 1);    // every post is kept: nothing to follow
  EXPECT_EQ(inside(false, 3, 0.2), 0.25);
  EXPECT_EQ(inside(false, 3, 0.19), 0.125);
  EXPECT_EQ(inside(false, 3, 0), 0.0625);
  EXPECT_EQ(inside(false, 0, 0), 1);
}

// The triangles of all cells of a grid, heights from `up`, in metres of one frame.
template <typename Up>
LocalMesh LatticeMesh(const Dem& dem, double cell_m, double east_m, Up up) {
  LocalMesh mesh;
  for (VertexId v = 0; v < dem.columns * dem.rows; ++v) {
    const double east = east_m + dem.Column(v) * cell_m;
    const double north = -dem.Row(v) * cell_m;
    mesh.positions.push_back({east, north, up(east, north)});
    mesh.posts.push_back(static_cast<std::uint32_t>(v));
    mesh.normals.push_back({0, 0, 1});
  }
  const Terrain terrain = *Terrain::Build(dem);
  for (const Triangle& t : terrain.Triangles()) {
    mesh.triangles.push_back({static_cast<std::uint32_t>(t[0]), static_cast<std::uint32_t>(t[1]),
                              static_cast<std::uint32_t>(t[2])});
  }
  return mesh;
}

TangentFrame SomeFrame() {
  const Placed some(DemOf(3, 3, [](int, int) { return 0; }), 30);
  return some.georeference->frame();
}

TEST(RoundToLattice, SidesOfNeighboursDecodeToTheSamePlaces) {
  // Two tiles that share a column; their insides are rounded by other steps.
  const Dem dem = DemOf(17, 17, [](int, int) { return 0; });
  const auto up = [](double east, double north) {
    return 300 + 37.7 * std::sin(east / 71.3) + 23.1 * std::cos(north / 57.9);
  };
  constexpr double kCell = 30.0127;
  LocalMesh west = LatticeMesh(dem, kCell, -16 * kCell, up);
  LocalMesh east = LatticeMesh(dem, kCell, 0, up);
  LatticeSteps west_steps = {0.5, 0.5};
  LatticeSteps east_steps = {0.5, 0.03125};
  const QuantizationLattice west_lattice = *RoundToLattice(dem, SomeFrame(), west_steps, west);
  const QuantizationLattice east_lattice = *RoundToLattice(dem, SomeFrame(), east_steps, east);
  EXPECT_EQ(west_lattice.step_m, 0.5);
  EXPECT_EQ(east_lattice.step_m, 0.03125);
  const auto decoded = [](const LocalMesh& mesh, const QuantizationLattice& lattice,
                          std::uint32_t column) {
    const LocalMesh back = DecodeDraco(*EncodeDraco(mesh, lattice))->mesh;
    std::map<std::uint32_t, std::array<double, 3>> by_row;
    for (std::size_t i = 0; i < back.posts.size(); ++i) {
      const Enu& p = back.positions[i];
      if (back.posts[i] % 17 == column) by_row[back.posts[i] / 17] = {p.east, p.north, p.up};
    }
    return by_row;
  };
  EXPECT_EQ(decoded(west, west_lattice, 16), decoded(east, east_lattice, 0));
  EXPECT_EQ(decoded(west, west_lattice, 16).size(), 17U);
}

// The vertices of column `column` of each level of a tile, decoded: row and place, in a frame in
// which the tile's first column is at `east_m`.
std::vector<std::map<std::int32_t, std::array<double, 3>>> ColumnOfLevels(const Placed& tile,
                                                                          std::int32_t column,
                                                                          double east_m) {
  constexpr double kCell = 30.0127;
  const Horizon horizon = *FindHorizon(tile.terrain, {}, {});
  LodPlan plan;
  plan.max_error_m = 4;
  std::vector<std::map<std::int32_t, std::array<double, 3>>> levels;
  const std::vector<Lod> chain = *BuildLodChain(tile.terrain, horizon, plan, {});
  for (const Lod& lod : chain) {
    LocalMesh mesh;
    std::map<VertexId, std::uint32_t> index;
    for (std::size_t i = 0; i < lod.mesh.posts.size(); ++i) {
      const VertexId v = lod.mesh.posts[i];
      index[v] = static_cast<std::uint32_t>(i);
      mesh.positions.push_back(
          {east_m + tile.dem.Column(v) * kCell, -tile.dem.Row(v) * kCell, lod.mesh.heights_m[i]});
      mesh.posts.push_back(static_cast<std::uint32_t>(v));
      mesh.normals.push_back({0, 0, 1});
    }
    for (const Triangle& t : lod.mesh.triangles) {
      mesh.triangles.push_back({index[t[0]], index[t[1]], index[t[2]]});
    }
    LatticeSteps steps = StepsOfLevel(FinestSideStep(*tile.georeference, 0), *tile.georeference,
                                      lod, static_cast<int>(levels.size()));
    const QuantizationLattice lattice = *RoundToLattice(tile.dem, SomeFrame(), steps, mesh);
    const LocalMesh back = DecodeDraco(*EncodeDraco(mesh, lattice))->mesh;
    auto& by_row = levels.emplace_back();
    for (std::size_t i = 0; i < back.posts.size(); ++i) {
      const auto post = static_cast<VertexId>(back.posts[i]);
      const Enu& p = back.positions[i];
      if (tile.dem.Column(post) == column) by_row[tile.dem.Row(post)] = {p.east, p.north, p.up};
    }
  }
  return levels;
}

TEST(RoundToLattice, TilesCutFromOneDemMeetAtEveryLevel) {
  // The one's ground is ten times as rough as the other's, but for the column that they share.
  const Dem whole = FractalDem(6, 50);
  const auto cut = [&whole](std::int32_t first, double roughness) {
    return DemOf(65, 65, [&](int c, int r) {
      const int column = std::abs(c + first - 64);  // of the whole, mirrored at the shared column
      const double height = whole.heights[static_cast<std::size_t>(r * 65 + 64 - column)];
      return static_cast<std::int32_t>(column == 0 ? height : height * roughness);
    });
  };
  const Placed west(cut(0, 1), 30);
  const Placed east(cut(64, 0.1), 30);
  const auto one = ColumnOfLevels(west, 64, -64 * 30.0127);
  const auto other = ColumnOfLevels(east, 0, 0);
  const std::size_t common = std::min(one.size(), other.size());
  ASSERT_GE(common, 2U);
  for (std::size_t level = 0; level < common; ++level) {
    EXPECT_EQ(one[level], other[level]) << "level " << level;
    EXPECT_GE(one[level].size(), 2U);
  }
}

TEST(RoundToLattice, StepsGrowWhereTheBitsDoNotReach) {
  const Dem dem = DemOf(9, 9, [](int, int) { return 0; });
  const auto level = [](double, double) { return 100.0; };
  LocalMesh mesh = LatticeMesh(dem, 5000, 0, level);
  LatticeSteps steps = {0.015625, 0.0078125};
  const QuantizationLattice lattice = *RoundToLattice(dem, SomeFrame(), steps, mesh);
  EXPECT_EQ(lattice.step_m, 0.125);  // 320,000 steps; half of it would take 640,000
  EXPECT_EQ(steps.inside_m, 0.125);
  EXPECT_EQ(steps.sides_m, 0.125);
  EXPECT_TRUE(EncodeDraco(mesh, lattice));
}

TEST(RoundToLattice, StepsShrinkUntilNoTriangleIsFlipped) {
  // A needle, 5 cm high over 100 m: steps of a metre make it flat.
  const Dem dem = DemOf(101, 3, [](int, int) { return 0; });
  LocalMesh mesh;
  mesh.positions = {{0, 0.6, 0}, {50, 0.65, 0}, {100, 0.6, 0}, {50, 40, 0}};
  mesh.posts = {101 + 1, 101 + 50, 101 + 99, 50};
  mesh.normals.assign(4, {0, 0, 1});
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}};
  ASSERT_TRUE(AllTurnLeft(mesh, SomeFrame()));
  LatticeSteps steps = {1, 1};
  const Result<QuantizationLattice> lattice = RoundToLattice(dem, SomeFrame(), steps, mesh);
  ASSERT_TRUE(lattice) << lattice.error().message;
  EXPECT_LT(lattice->step_m, 1);
  EXPECT_TRUE(AllTurnLeft(mesh, SomeFrame()));
  EXPECT_EQ(steps.sides_m, lattice->step_m);
}

TEST(RoundToLattice, AMeshThatIsFlippedIsRefused) {
  const Dem dem = DemOf(3, 3, [](int, int) { return 0; });
  const auto level = [](double, double) { return 100.0; };
  LocalMesh mesh = LatticeMesh(dem, 30, 0, level);
  std::swap(mesh.triangles[3][0], mesh.triangles[3][1]);
  LatticeSteps steps = {0.5, 0.5};
  const Result<QuantizationLattice> lattice = RoundToLattice(dem, SomeFrame(), steps, mesh);
  ASSERT_FALSE(lattice);
  EXPECT_EQ(lattice.error().kind, "flipped-triangle");
  EXPECT_THAT(lattice.error().message, testing::HasSubstr("gdalwarp"));
}

}  // namespace
}  // namespace farhorizon

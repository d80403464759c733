#include "core/pipeline/skirt.h"

#include <array>
#include <cmath>
#include <set>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/geo/ellipsoid_normal.h"
#include "tests/support/local_meshes.h"
#include "tests/support/placed_dem.h"

namespace farhorizon {
namespace {

using Place = std::array<double, 3>;
using Sides = std::multiset<std::pair<Place, Place>>;

Place PlaceOfPoint(const Enu& p) { return {p.east, p.north, p.up}; }

// A grid with a slanted outline and a hole, on a lattice with room below.
struct Ground {
  static constexpr double kStep = 0.25;
  static constexpr double kDepth = 37.1;
  TangentFrame frame = {{0, 60, 0}, {3197104.587, 0, 5500477.134}};
  LocalMesh mesh = HillyGrid(
      12, 11, 30, [](std::uint32_t c, std::uint32_t r) { return c + r < 5 || (c == 7 && r == 6); });
  QuantizationLattice lattice;
  LocalMesh skirt;

  Ground() {
    std::vector<Enu> reach = mesh.positions;
    reach.push_back({0, 0, 0});
    lattice = ChooseLattice(reach, kStep);
    for (Enu& p : mesh.positions) p = SnapToLattice(p, lattice);
    skirt = SkirtOf(mesh, frame, lattice, kDepth);
  }
};

Sides SidesOfSkirt(const LocalMesh& mesh) {
  Sides sides;
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      sides.emplace(PlaceOfPoint(mesh.positions[t[k]]),
                    PlaceOfPoint(mesh.positions[t[(k + 1) % 3]]));
    }
  }
  return sides;
}

std::size_t CountOpen(const Sides& sides) {
  std::size_t open = 0;
  for (const auto& [a, b] : sides) open += sides.contains({b, a}) ? 0 : 1;
  return open;
}

// With its skirt the mesh is one surface, turned one way, that is open at the bottom alone.
TEST(Skirt, ClosesEveryRimAndFacesOutwards) {
  const Ground ground;
  Sides sides = SidesOfSkirt(ground.mesh);
  const std::size_t rim = CountOpen(sides);
  ASSERT_EQ(ground.skirt.triangles.size(), 2 * rim);
  for (const auto& side : SidesOfSkirt(ground.skirt)) {
    EXPECT_EQ(sides.count(side), 0U) << "a side twice in one direction";
    sides.insert(side);
  }
  EXPECT_EQ(CountOpen(sides), rim);
  const std::size_t tops = ground.skirt.positions.size() / 2;
  for (const auto& t : ground.skirt.triangles) {
    EXPECT_TRUE(t[0] >= tops) << "the first corner is at the bottom";
  }
}

TEST(Skirt, HangsFromTheRimBitForBitAlongThePlumbLine) {
  const Ground ground;
  std::set<Place> places;
  for (const Enu& p : ground.mesh.positions) places.insert(PlaceOfPoint(p));
  const std::size_t tops = ground.skirt.positions.size() / 2;
  for (std::size_t i = 0; i < tops; ++i) {
    const Enu& top = ground.skirt.positions[i];
    const Enu& bottom = ground.skirt.positions[tops + i];
    EXPECT_TRUE(places.contains(PlaceOfPoint(top)));
    EXPECT_EQ(PlaceOfPoint(SnapToLattice(bottom, ground.lattice)), PlaceOfPoint(bottom));
    const Enu up = EllipsoidNormal(top, ground.frame);
    const double share = Ground::kDepth / std::hypot(up.east, up.north, up.up);
    EXPECT_LE(std::abs(top.east - share * up.east - bottom.east), Ground::kStep / 2);
    EXPECT_LE(std::abs(top.north - share * up.north - bottom.north), Ground::kStep / 2);
    EXPECT_LE(std::abs(top.up - share * up.up - bottom.up), Ground::kStep / 2);
  }
}

TEST(Skirt, IsLitAsTheRimIs) {
  const Ground ground;
  std::set<std::pair<Place, UnitNormal>> lit;
  for (std::size_t i = 0; i < ground.mesh.positions.size(); ++i) {
    lit.emplace(PlaceOfPoint(ground.mesh.positions[i]), ground.mesh.normals[i]);
  }
  const std::size_t tops = ground.skirt.positions.size() / 2;
  for (std::size_t i = 0; i < tops; ++i) {
    EXPECT_TRUE(lit.contains({PlaceOfPoint(ground.skirt.positions[i]), ground.skirt.normals[i]}));
    EXPECT_EQ(ground.skirt.normals[i], ground.skirt.normals[tops + i]);
  }
}

LevelReport LevelOff(double error_m, double step_m) {
  LevelReport level;
  level.geometric_error_m = error_m;
  level.quantization_step_m = step_m;
  level.side_step_m = 2;
  return level;
}

double ReliefOf(const PlacedDem& dem) {
  const auto& [least_m, greatest_m] = dem.input().report().heights_m;
  return greatest_m - least_m;
}

TEST(SkirtDepths, AreAsDeepAsTheErrorsOfTwoLevelsThatMeetAndTheRelief) {
  const PlacedDem dem;
  const double relief_m = ReliefOf(dem);
  ASSERT_EQ(relief_m, std::floor(relief_m));
  const std::vector<LevelReport> levels = {LevelOff(3, 0.25), LevelOff(10, 0.5), LevelOff(30, 1)};
  EXPECT_THAT(SkirtDepths(dem.input(), levels, std::nullopt),
              testing::ElementsAre(relief_m + 35, relief_m + 42, relief_m + 62));
  EXPECT_THAT(SkirtDepths(dem.input(), levels, 12.6), testing::ElementsAre(12.75, 13, 13));
  EXPECT_THAT(SkirtDepths(dem.input(), levels, 0), testing::ElementsAre(0, 0, 0));
}

TEST(SkirtDepths, AreNoThinnerThanAPixelAndNoDeeperThanTheRoom) {
  const PlacedDem dem;
  const double diagonal_m = std::hypot(29 * dem.input().georeference().column_step_m(),
                                       19 * dem.input().georeference().row_step_m());
  EXPECT_THAT(SkirtDepths(dem.input(), {LevelOff(0, 0.25)}, std::nullopt),
              testing::ElementsAre(ReliefOf(dem) + std::ceil(diagonal_m / 512 * 4) / 4));
  const double room_m = MostSkirtDepth(dem.input(), std::nullopt);
  EXPECT_GE(room_m, 3 * ReliefOf(dem));
  EXPECT_LE(SkirtDepths(dem.input(), {LevelOff(9000, 0.25)}, std::nullopt).front(), room_m + 0.25);
}

}  // namespace
}  // namespace farhorizon

#include "core/pipeline/report_page/skyline_profile.h"

#include <cmath>
#include <optional>
#include <random>

#include <gtest/gtest.h>

#include "core/horizon/find_horizon.h"
#include "core/horizon/lines/highest_over_line.h"
#include "tests/support/grid_meshes.h"
#include "tests/support/metre_steps.h"
#include "tests/support/terrains.h"

namespace farhorizon {
namespace {

// Line i of those that LinesAcross lays towards `azimuth`, half way between posts.
PlanLine Line(int azimuth, int i, const Dem& dem) {
  switch (azimuth) {
    case 0:  // from west to east
      return {2 * i + 1, 0, 0, 1};
    case 90:  // looking east, north is on the left
      return {0, 2 * i + 1, 1, 0};
    case 45:  // looking north-east, the north-west corner is on the left: column + row rises
      return {2 * i + 1, 0, 1, -1};
    default:  // looking south-east, the north-east corner is on the left: column - row falls
      return {2 * (dem.columns - 1 - i) - 1, 0, 1, 1};
  }
}

double AsDouble(const ExactHeight& height) {
  return static_cast<double>(height.numerator) / static_cast<double>(height.denominator);
}

int LinesBetween(int azimuth, const Dem& dem) {
  if (azimuth == 0) return dem.columns - 1;
  if (azimuth == 90) return dem.rows - 1;
  return dem.columns + dem.rows - 2;
}

// Against the definition, which is exact.
TEST(ProfileOf, IsTheGreatestHeightOverEachLine) {
  std::mt19937 random(4);
  int compared = 0;
  for (int i = 0; i < 40; ++i) {
    const Dem dem = RandomDem({3 + i % 9, 2 + i % 7, 30, i % 3 == 0 ? 20 : 0}, random);
    const Result<Terrain> terrain = Terrain::Build(dem);
    if (!terrain) continue;
    const Horizon horizon = *FindHorizon(*terrain, {}, {});
    for (const int azimuth : {0, 45, 90, 135}) {
      const ParallelLines lines =
          LinesAcross(dem, kMetreSteps, azimuth, LinesBetween(azimuth, dem));
      const SkylineProfile of_horizon = ProfileOf(dem, horizon, lines);
      const SkylineProfile of_mesh = ProfileOf(WholeMesh(*terrain), lines);
      for (int k = 0; k < lines.count; ++k) {
        const auto at = static_cast<std::size_t>(k);
        const std::optional<ExactHeight> exact = HighestOver(*terrain, Line(azimuth, k, dem));
        ASSERT_EQ(exact.has_value(), !std::isnan(of_mesh[at])) << azimuth << " line " << k;
        ASSERT_EQ(exact.has_value(), !std::isnan(of_horizon[at])) << azimuth << " line " << k;
        if (!exact) continue;
        EXPECT_NEAR(of_mesh[at], AsDouble(*exact), 1e-9) << azimuth << " line " << k;
        EXPECT_NEAR(of_horizon[at], AsDouble(*exact), 1e-9) << azimuth << " line " << k;
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 500);
}

TEST(LinesAcross, RunFromLeftToRight) {
  const Dem dem = MakeDem(11, 5, [](auto, auto) { return 0; });
  const ParallelLines north = LinesAcross(dem, kMetreSteps, 0, 10);
  EXPECT_NEAR(north.OffsetOf(0, 0), -5, 1e-12) << "west is on the left";
  EXPECT_NEAR(north.OffsetOf(10, 4), 5, 1e-12);
  EXPECT_NEAR(north.OffsetOfLine(0), -4.5, 1e-12);
  EXPECT_NEAR(north.OffsetOfLine(9), 4.5, 1e-12);
  const ParallelLines east = LinesAcross(dem, kMetreSteps, 90, 10);
  EXPECT_NEAR(east.OffsetOf(0, 0), -2, 1e-12) << "north is on the left";
  EXPECT_NEAR(east.OffsetOf(10, 4), 2, 1e-12);
}

TEST(ProfileOf, AnEdgeAlongALineIsAsHighAsItsHigherEnd) {
  GridMesh mesh;
  mesh.points = {{1, 0, 3}, {1, 2, 8}, {1, 1, 5}};
  mesh.triangles = {{0, 1, 2}};
  const Dem dem = MakeDem(3, 3, [](auto, auto) { return 0; });
  const ParallelLines lines = LinesAcross(dem, kMetreSteps, 0, 1);  // one, through the middle
  EXPECT_EQ(ProfileOf(mesh, lines).front(), 8);
}

TEST(PointOfCompass, NamesEight) {
  EXPECT_EQ(PointOfCompass(0), "north");
  EXPECT_EQ(PointOfCompass(135), "south-east");
  EXPECT_EQ(PointOfCompass(315), "north-west");
}

}  // namespace
}  // namespace farhorizon

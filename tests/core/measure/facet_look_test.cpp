#include "core/measure/facet_look.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/support/drawn_dem.h"
#include "tests/support/measured_meshes.h"

namespace farhorizon {
namespace {

PostPlaces Steps(double column_m, double row_m) {
  PostPlaces places;
  places.column_m = column_m;
  places.row_m = row_m;
  return places;
}

TEST(FacetLook, IsTheAngleBetweenPlanes) {
  const Dem flat = DemOf(5, 4, [](int, int) { return 7; });
  const Terrain terrain = *Terrain::Build(flat);
  for (const double rise : {0.0, 0.1, 2.0, 40.0, 4000.0}) {
    GridMesh mesh = MeshOf(terrain);
    for (GridPoint& p : mesh.points) p.height_m = rise * p.row;
    EXPECT_NEAR(MeasureFacets(terrain, mesh, Steps(10, 20)).angle_rms_deg,
                std::atan(rise / 20) * 180 / std::numbers::pi, 1e-5);
  }
}

TEST(FacetLook, IsZeroForTheTerrainAlsoBesideHoles) {
  const Dem dem = DrawnDem(R"(
    1 5 2 9 .
    3 . 8 2 5
    7 7 1 . 3
    4 0 6 2 8
  )");
  const Terrain terrain = *Terrain::Build(dem);
  const GridMesh mesh = MeshOf(terrain);
  EXPECT_NEAR(MeasureFacets(terrain, mesh, Steps(1, 1)).angle_rms_deg, 0, 1e-5);
}

TEST(FacetLook, CountsNeedles) {
  const Dem dem = DemOf(5, 5, [](int, int) { return 0; });
  const Terrain terrain = *Terrain::Build(dem);
  // A long thin triangle at the north side, and two that are none; a cliff is none either.
  GridMesh mesh = {{{0, 0, 0}, {4, 0, 0}, {2, 0.05, 0}, {0, 4, 0}, {4, 4, 0}},
                   {{0, 2, 1}, {0, 3, 2}, {2, 4, 1}, {2, 3, 4}}};
  EXPECT_EQ(MeasureFacets(terrain, mesh, Steps(1, 1)).needle_share, 0.25);
  EXPECT_EQ(MeasureFacets(terrain, mesh, Steps(1, 10)).needle_share, 0);
  mesh.points[2].height_m = 3;
  EXPECT_EQ(MeasureFacets(terrain, mesh, Steps(1, 1)).needle_share, 0);
}

}  // namespace
}  // namespace farhorizon

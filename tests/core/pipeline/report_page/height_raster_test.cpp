#include "core/pipeline/report_page/height_raster.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "core/pipeline/report_page/relief.h"
#include "tests/support/grid_meshes.h"
#include "tests/support/metre_steps.h"
#include "tests/support/terrains.h"

namespace farhorizon {
namespace {

TEST(RasterOf, ATerrainAndItsWholeMeshAreOneSurface) {
  std::mt19937 random(14);
  for (int i = 0; i < 12; ++i) {
    const Dem dem = RandomDem({5 + i, 4 + i % 5, 20, i % 2 == 0 ? 0 : 15}, random);
    const Result<Terrain> terrain = Terrain::Build(dem);
    if (!terrain) continue;
    const PictureFrame frame = FrameOf(dem, kMetreSteps);
    const HeightRaster of_terrain = RasterOf(*terrain, frame);
    const HeightRaster of_mesh = RasterOf(WholeMesh(*terrain), frame, of_terrain.base_m);
    ASSERT_EQ(of_terrain.heights_m.size(), of_mesh.heights_m.size());
    std::size_t apart = 0;
    for (std::size_t k = 0; k < of_mesh.heights_m.size(); ++k) {
      const float a = of_terrain.heights_m[k];
      const float b = of_mesh.heights_m[k];
      // A sample on a hole's outline may be seen on either side of it.
      if (std::isnan(a) != std::isnan(b)) {
        ++apart;
      } else if (!std::isnan(a)) {
        ASSERT_NEAR(a, b, 1e-4) << "sample " << k << " of grid " << i;
      }
    }
    EXPECT_LE(apart, of_mesh.heights_m.size() / 100);
  }
}

TEST(RasterOf, APlaneIsAPlaneWhicheverWayTheGridLies) {
  for (const bool flips : {false, true}) {
    Dem dem = MakeDem(7, 5, [](std::int32_t c, std::int32_t r) { return 30 + 2 * c + 3 * r; });
    dem.transform = {0, 0, flips ? -1.0 : 1.0, flips ? 1.0 : -1.0};
    const PictureFrame frame = FrameOf(dem, kMetreSteps);
    const HeightRaster raster = RasterOf(*Terrain::Build(dem), frame);
    EXPECT_EQ(raster.base_m, 30);
    // The map's upper left corner is post (0, 0), or the opposite one.
    EXPECT_NEAR(raster.heights_m.front(), flips ? 24 : 0, 0.1);
    EXPECT_NEAR(raster.heights_m.back(), flips ? 0 : 24, 0.1);
    const GreyPicture relief = ShadedRelief(raster, frame, 1);
    // Inside, where no difference is of one side alone, a plane has one shade.
    const auto at = [&](int x, int y) {
      return relief.values[static_cast<std::size_t>(y * frame.width + x)];
    };
    EXPECT_NEAR(at(10, 10), at(frame.width - 10, frame.height - 10), 1);
  }
}

TEST(FrameOf, KeepsSquareGroundSquareAndStripsVisible) {
  const PictureFrame square = FrameOf(MakeDem(9, 9, [](auto, auto) { return 0; }), kMetreSteps);
  EXPECT_EQ(square.width, square.height);
  EXPECT_FALSE(square.IsStretched());
  const PictureFrame strip = FrameOf(MakeDem(2, 4000, [](auto, auto) { return 0; }), kMetreSteps);
  EXPECT_GE(strip.width, 40);
  EXPECT_LE(strip.height, 1024);
  EXPECT_TRUE(strip.IsStretched());
  EXPECT_EQ(strip.samples, 4);
}

TEST(ShadedRelief, LevelGroundHasOneShadeAndHolesAreWhite) {
  Dem dem = MakeDem(6, 6, [](auto, auto) { return 7; });
  dem.heights[14] = kNoHeight;
  const PictureFrame frame = FrameOf(dem, kMetreSteps);
  const HeightRaster raster = RasterOf(*Terrain::Build(dem), frame);
  EXPECT_EQ(ReliefExaggeration(raster, frame), 1);
  const GreyPicture relief = ShadedRelief(raster, frame, 1);
  for (const std::uint8_t value : relief.values) EXPECT_TRUE(value == 255 || value == 196) << value;
  EXPECT_EQ(relief.values.front(), 196);
  EXPECT_EQ(
      relief.values[relief.values.size() * 2 / 5 + static_cast<std::size_t>(frame.width) * 2 / 5],
      255);
}

TEST(ShadedRelief, SlopesTowardsTheLightAreBrighter) {
  const auto shade = [](int dc, int dr) {
    const Dem dem = MakeDem(5, 5, [=](std::int32_t c, std::int32_t r) { return dc * c + dr * r; });
    const PictureFrame frame = FrameOf(dem, kMetreSteps);
    const GreyPicture relief = ShadedRelief(RasterOf(*Terrain::Build(dem), frame), frame, 1);
    return relief.values[relief.values.size() / 2 + 5];
  };
  EXPECT_GT(shade(1, 1), shade(0, 0)) << "rises away from the upper left";
  EXPECT_LT(shade(-1, -1), shade(0, 0));
}

}  // namespace
}  // namespace farhorizon

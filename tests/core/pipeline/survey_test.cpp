// Tiles of one survey, made apart, and what the call says of them.
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/pipeline/terrain_input.h"
#include "tests/support/temp_dir.h"
#include "tests/support/test_raster.h"

namespace farhorizon {
namespace {

using ::testing::Contains;
using ::testing::Field;
using ::testing::HasSubstr;

class Survey : public ::testing::Test {
 protected:
  // Eleven columns of cells of a hundredth of a degree, the first post at `west`, at 45.1 north.
  std::unique_ptr<TerrainInput> Tile(const std::string& crs, double west,
                                     const BuildOptions& options = {}) {
    TestRaster raster{.columns = 11, .rows = 8, .crs = crs};
    raster.values.clear();
    for (int i = 0; i < 11 * 8; ++i) raster.values.push_back(100 + i % 7);
    raster.geotransform = {west - 0.005, 0.01, 0, 45.1, 0, -0.01};
    WriteTiff(dir_ / "dem.tif", raster);
    auto input = TerrainInput::Open(dir_ / "dem.tif", options, {});
    if (!input) throw std::runtime_error(input.error().message);
    return std::move(*input);
  }

  static Geodetic Post(const TerrainInput& tile, int column, int row) {
    const auto placed = tile.georeference().ToGeodetic(std::vector<VertexId>{row * 11 + column});
    if (!placed) throw std::runtime_error(placed.error().message);
    return placed->front();
  }

  TempDir dir_;
};

// The border of Ontario and Quebec, where PROJ by itself changes its operation from NAD27.
TEST_F(Survey, TilesPlaceThePostsThatTheyShareAlike) {
  for (const char* crs : {"EPSG:4267", "EPSG:4230", "EPSG:4269", "EPSG:4326+5773"}) {
    const auto west = Tile(crs, -79.65);
    const auto east = Tile(crs, -79.55);
    for (const int row : {0, 7}) {
      const Geodetic a = Post(*west, 10, row);
      const Geodetic b = Post(*east, 0, row);
      // A micrometre: longitudes of the two geotransforms are rounded apart.
      EXPECT_NEAR(a.lon_deg, b.lon_deg, 1e-11) << crs;
      EXPECT_NEAR(a.lat_deg, b.lat_deg, 1e-11) << crs;
    }
  }
}

TEST_F(Survey, TheDatumOperationThatIsStatedPlacesThem) {
  const auto by_default = Tile("EPSG:4267", -79.65);
  EXPECT_THAT(by_default->assumptions(),
              Contains(Field(&Assumption::code, std::string("datum-operation"))));
  BuildOptions options;
  options.datum_operation = "ballpark";
  const auto stated = Tile("EPSG:4267", -79.65, options);
  EXPECT_NEAR(Post(*stated, 0, 0).lon_deg, -79.65, 1e-9);
  EXPECT_GT(std::abs(Post(*by_default, 0, 0).lon_deg + 79.65), 1e-5);
  options.datum_operation = "EPSG:1";
  const auto refused = TerrainInput::Open(dir_ / "dem.tif", options, {});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
  EXPECT_THAT(refused.error().message, HasSubstr("EPSG:1172"));
}

TEST_F(Survey, ADemThatStatesAllAssumesNothing) {
  EXPECT_TRUE(Tile("EPSG:4326+5773", 8)->assumptions().empty());
}

// Depths of 100 to 106 m under mean sea level, which is 45.204 m above the ellipsoid at the first
// post (EGM96, by cs2cs).
TEST_F(Survey, DepthsAreBelowTheGeoid) {
  const auto tile = Tile("EPSG:4326+5715", 8);
  EXPECT_EQ(tile->report().heights_m[0], -106);
  EXPECT_EQ(tile->report().heights_m[1], -100);
  EXPECT_NEAR(Post(*tile, 0, 0).height_m, -100 + 45.204, 0.001);
}

}  // namespace
}  // namespace farhorizon

// Every real DEM of the shared collection. Sizes, counts of posts without data and heights were
// taken from the files by other means (gdalinfo, and gdal_translate to raw numbers counted by a
// script).
#include <algorithm>
#include <filesystem>
#include <limits>

#include <gtest/gtest.h>

#include "core/geo/globe_transform.h"
#include "core/io/dem/read_dem.h"

namespace farhorizon {
namespace {

struct RealDem {
  const char* name;
  int columns;
  int rows;
  const char* crs;
  double least_m;
  double greatest_m;
  std::int64_t nodata_posts;
  bool quantized;
};

void PrintTo(const RealDem& dem, std::ostream* out) { *out << dem.name; }

class RealDems : public ::testing::TestWithParam<RealDem> {};

TEST_P(RealDems, IsReadAsItsListSays) {
  const RealDem& expected = GetParam();
  const std::filesystem::path path = std::filesystem::path(FARHORIZON_DEM_DIR) / expected.name;
  if (!std::filesystem::exists(path))
    GTEST_SKIP() << "no " << expected.name << " in FARHORIZON_DEM_DIR";
  Result<Dem> dem = ReadDem(path, {});
  ASSERT_TRUE(dem) << dem.error().message;
  EXPECT_EQ(dem->columns, expected.columns);
  EXPECT_EQ(dem->rows, expected.rows);
  EXPECT_EQ(dem->crs, expected.crs);
  EXPECT_EQ(dem->quantized, expected.quantized);
  double least = std::numeric_limits<double>::max();
  double greatest = std::numeric_limits<double>::lowest();
  std::int64_t nodata = 0;
  for (VertexId v = 0; v < dem->columns * dem->rows; ++v) {
    if (!dem->HasData(v)) {
      ++nodata;
      continue;
    }
    least = std::min(least, dem->HeightM(v));
    greatest = std::max(greatest, dem->HeightM(v));
  }
  const double tolerance_m = expected.quantized ? dem->quantum_m / 2 : 0;
  EXPECT_NEAR(least, expected.least_m, tolerance_m);
  EXPECT_NEAR(greatest, expected.greatest_m, tolerance_m);
  EXPECT_EQ(nodata, expected.nodata_posts);
}

TEST_P(RealDems, LiesOnTheGlobeAndComesBack) {
  const std::filesystem::path path = std::filesystem::path(FARHORIZON_DEM_DIR) / GetParam().name;
  if (!std::filesystem::exists(path))
    GTEST_SKIP() << "no " << GetParam().name << " in FARHORIZON_DEM_DIR";
  Result<Dem> dem = ReadDem(path, {});
  ASSERT_TRUE(dem) << dem.error().message;
  std::vector<MapPoint> corners;
  for (const int row : {0, dem->rows - 1}) {
    for (const int column : {0, dem->columns - 1}) {
      corners.push_back({dem->transform.origin_x + column * dem->transform.step_x,
                         dem->transform.origin_y + row * dem->transform.step_y, 100});
    }
  }
  Result<GlobeTransform> globe = GlobeTransform::Open(dem->crs, {.about = corners[0]});
  ASSERT_TRUE(globe) << globe.error().message;
  Result<std::vector<Geodetic>> there = globe->ToGeodetic(corners);
  ASSERT_TRUE(there) << there.error().message;
  Result<std::vector<MapPoint>> back = globe->FromGeodetic(*there);
  ASSERT_TRUE(back) << back.error().message;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    EXPECT_NEAR((*back)[i].x, corners[i].x, 1e-4 * std::abs(dem->transform.step_x));
    EXPECT_NEAR((*back)[i].y, corners[i].y, 1e-4 * std::abs(dem->transform.step_y));
    EXPECT_EQ((*there)[i].height_m, 100);
  }
}

TEST(ShippedDem, IsReadAsItsReadmeSays) {
  Result<Dem> dem = ReadDem(
      std::filesystem::path(FARHORIZON_SOURCE_DIR) / "tests/data/jacksboro_fault_dem.tif", {});
  ASSERT_TRUE(dem) << dem.error().message;
  EXPECT_EQ(dem->columns, 403);
  EXPECT_EQ(dem->rows, 344);
  EXPECT_EQ(dem->crs, "EPSG:4326");
  EXPECT_EQ(std::ranges::min(dem->heights), 236);
  EXPECT_EQ(std::ranges::max(dem->heights), 1076);
  EXPECT_EQ(dem->quantum_m, 1);
  EXPECT_NEAR(dem->transform.origin_x, -(84 + 24 / 60.0 + 48 / 3600.0), 1e-10);
  EXPECT_NEAR(dem->transform.origin_y, 36 + 43 / 60.0 + 57 / 3600.0, 1e-10);
}

INSTANTIATE_TEST_SUITE_P(
    Shared, RealDems,
    ::testing::Values(
        RealDem{"capetown_srtm3_nodata_sea.tif", 723, 1105, "EPSG:4326", -28.0, 1077.0, 311658,
                false},
        RealDem{"fortworth_srtm3_rolling.tif", 367, 359, "EPSG:4326", 147.0, 298.0, 0, false},
        RealDem{"gabilan_65.tif", 65, 65, "EPSG:32610", 274.5199890136719, 285.20001220703125, 0,
                false},
        RealDem{"gabilan_lidar_utm10n_1m.tif", 921, 859, "EPSG:32610", 187.89999389648438,
                307.2799987792969, 0, false},
        RealDem{"mandakini_alpine_257.tif", 257, 257, "EPSG:32644", 1068.0, 6063.0, 0, false},
        RealDem{"mandakini_utm44n_89m.tif", 587, 648, "EPSG:32644", 644.0, 6741.0, 172089, false},
        RealDem{"n44w072_srtm3_1201.tif", 1201, 1201, "EPSG:4326", 115.0, 1908.0, 0, false},
        RealDem{"ontario_dted0_121.tif", 121, 121, "EPSG:4326", 75.0, 460.0, 0, false},
        RealDem{"ontario_n43.dt0", 121, 121, "EPSG:4326", 75.0, 460.0, 0, false},
        RealDem{"presidential_srtm3_513.tif", 513, 513, "EPSG:4326", 143.0, 1908.0, 0, false},
        RealDem{"sandiego_coast_512.tif", 512, 512, "EPSG:4326", -0.5151601433753967,
                452.2585144042969, 0, true},
        RealDem{"sanfrancisco_3857_512.tif", 512, 512, "EPSG:3857", 0.4360104203224182,
                114.92089080810547, 0, true},
        RealDem{"spearfish_nad27_utm13n_30m_nodata.tif", 634, 477, "EPSG:26713", 1066.0, 1840.0,
                10101, false},
        RealDem{"sthelens_crater_129.tif", 129, 129, "EPSG:26710", 1367.0, 2543.0, 0, false},
        RealDem{"sthelens_utm10n_30m.tif", 327, 468, "EPSG:26710", 682.0, 2543.0, 4151, false},
        RealDem{"zion_257.tif", 257, 257, "EPSG:4326", 1094.0, 2722.0, 0, false},
        RealDem{"zion_srtm3_uint16.tif", 465, 457, "EPSG:4326", 1024.0, 2892.0, 0, false}),
    [](const ::testing::TestParamInfo<RealDem>& dem) {
      std::string name = dem.param.name;
      std::ranges::replace(name, '.', '_');
      return name;
    });

}  // namespace
}  // namespace farhorizon

#include "core/io/dem/place/raster_place.h"

#include <gdal.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/dem/read_dem.h"
#include "tests/support/temp_dir.h"
#include "tests/support/test_raster.h"

namespace farhorizon {
namespace {

using ::testing::HasSubstr;

// A raster of 3 x 2 cells of 30 m without a place of its own, and what is beside it.
class RasterPlace : public ::testing::Test {
 protected:
  std::filesystem::path Tiff(std::optional<std::array<double, 6>> geotransform,
                             const std::string& crs = "EPSG:32610") {
    WriteTiff(dir_ / "dem.tif", {.geotransform = geotransform, .crs = crs});
    return dir_ / "dem.tif";
  }

  // Gives the raster control points: the corners of its cells where `c` puts them.
  std::filesystem::path Tied(const std::array<double, 6>& c, double fourth_off = 0) {
    Tiff(std::nullopt);
    const GDALDatasetH dataset = GDALOpen((dir_ / "dem.tif").c_str(), GA_Update);
    const std::array<std::array<double, 2>, 4> corners = {{{0, 0}, {3, 0}, {3, 2}, {0, 2}}};
    std::array<GDAL_GCP, 4> points{};
    GDALInitGCPs(4, points.data());
    for (std::size_t i = 0; i < 4; ++i) {
      const auto [p, l] = corners[i];
      points[i].dfGCPPixel = p;
      points[i].dfGCPLine = l;
      points[i].dfGCPX = c[0] + c[1] * p + c[2] * l + (i == 3 ? fourth_off : 0);
      points[i].dfGCPY = c[3] + c[4] * p + c[5] * l;
    }
    EXPECT_EQ(GDALSetGCPs(dataset, 4, points.data(), GDALGetProjectionRef(dataset)), CE_None);
    GDALDeinitGCPs(4, points.data());
    GDALClose(dataset);
    return dir_ / "dem.tif";
  }

  static bool Says(const Dem& dem, const std::string& code) {
    return std::ranges::any_of(dem.assumptions,
                               [&](const Assumption& a) { return a.code == code; });
  }
  static void ExpectUsualPlace(const Result<Dem>& dem) {
    ASSERT_TRUE(dem) << dem.error().message;
    EXPECT_NEAR(dem->transform.origin_x, 500015, 1e-9);
    EXPECT_NEAR(dem->transform.origin_y, 5099985, 1e-9);
    EXPECT_NEAR(dem->transform.step_x, 30, 1e-9);
    EXPECT_NEAR(dem->transform.step_y, -30, 1e-9);
  }

  TempDir dir_;
};

constexpr std::array<double, 6> kUsual = {500000, 30, 0, 5100000, 0, -30};

TEST_F(RasterPlace, RotationsThatMoveNoPostAreTaken) {
  ExpectUsualPlace(ReadDem(Tiff({{500000, 30, 1e-13, 5100000, -1e-13, -30}}), {}));
  // Posts of 2 rows are half a row from the middle: 0.5 * 0.059 < 30 m / 1000.
  EXPECT_TRUE(ReadDem(Tiff({{500000, 30, 0.059, 5100000, 0, -30}}), {}));
  EXPECT_FALSE(ReadDem(Tiff({{500000, 30, 0.061, 5100000, 0, -30}}), {}));
}

TEST_F(RasterPlace, LargerRotationsAndTurnsAreRefusedWithTheWayToWarpThem) {
  for (const std::array<double, 6>& c :
       {std::array<double, 6>{500000, 30, 1, 5100000, 0, -30}, {500000, 0, 30, 5100000, 30, 0}}) {
    Result<Dem> dem = ReadDem(Tiff(c), {});
    ASSERT_FALSE(dem);
    EXPECT_EQ(dem.error().kind, "rotated-geotransform");
    EXPECT_THAT(dem.error().message, HasSubstr("gdalwarp"));
    EXPECT_THAT(dem.error().message, HasSubstr("-dstnodata")) << "or its rim would be ground";
  }
}

TEST_F(RasterPlace, ColumnsMayRunFromTheEast) {
  Result<Dem> dem = ReadDem(Tiff({{500090, -30, 0, 5100000, 0, -30}}), {});
  ASSERT_TRUE(dem) << dem.error().message;
  EXPECT_EQ(dem->transform.origin_x, 500075);
  EXPECT_EQ(dem->transform.step_x, -30);
}

TEST_F(RasterPlace, ControlPointsOnAGridAreItsPlace) {
  Result<Dem> dem = ReadDem(Tied(kUsual), {});
  ExpectUsualPlace(dem);
  EXPECT_EQ(dem->crs, "EPSG:32610");
}

TEST_F(RasterPlace, ControlPointsThatWarpAreRefusedAndNamed) {
  for (const auto& path : {Tied(kUsual, 5), Tied({500000, 30, 5, 5100000, 0, -30})}) {
    Result<Dem> dem = ReadDem(path, {});
    ASSERT_FALSE(dem);
    EXPECT_EQ(dem.error().kind, "rotated-geotransform");
    EXPECT_THAT(dem.error().message, HasSubstr("control points"));
    EXPECT_THAT(dem.error().message, HasSubstr("gdalwarp"));
  }
}

TEST_F(RasterPlace, AWorldFileBesideIsReadAndSaid) {
  for (const char* name : {"dem.tfw", "dem.tifw", "dem.wld", "dem.TFW"}) {
    const std::filesystem::path path = Tiff(std::nullopt);
    SpillFile(dir_ / name, "30.0\r\n0\n0\n-30,0\n+500015\n5099985\n");
    Result<Dem> dem = ReadDem(path, {});
    ExpectUsualPlace(dem);
    EXPECT_TRUE(Says(*dem, "world-file")) << name;
    std::filesystem::remove(dir_ / name);
  }
}

TEST_F(RasterPlace, AWorldFileThatIsNoneIsNamed) {
  for (const char* text : {"", "30\n0\n0\n-30\n500015\n", "30 0 0 -30 500015 north"}) {
    const std::filesystem::path path = Tiff(std::nullopt);
    SpillFile(dir_ / "dem.tfw", text);
    Result<Dem> dem = ReadDem(path, {});
    ASSERT_FALSE(dem);
    EXPECT_EQ(dem.error().kind, "degenerate-geotransform");
    EXPECT_THAT(dem.error().message, HasSubstr("dem.tfw"));
  }
}

TEST_F(RasterPlace, TheRastersOwnPlaceWinsOverAWorldFileWhichIsSaidWhereTheyDiffer) {
  SpillFile(dir_ / "dem.tfw", "30\n0\n0\n-30\n500015\n5099985\n");
  Result<Dem> same = ReadDem(Tiff(kUsual), {});
  ExpectUsualPlace(same);
  EXPECT_FALSE(Says(*same, "world-file"));
  SpillFile(dir_ / "dem.tfw", "30\n0\n0\n-30\n600015\n5099985\n");
  Result<Dem> other = ReadDem(Tiff(kUsual), {});
  ExpectUsualPlace(other);
  EXPECT_TRUE(Says(*other, "world-file"));
}

TEST_F(RasterPlace, APrjThatSaysOtherwiseThanTheRasterOrMoreIsSaid) {
  const std::string utm10 =
      "Projection UTM\nZone 10\nDatum WGS84\nSpheroid WGS84\nUnits METERS\nZunits METERS\n"
      "Xshift 0.0\nYshift 0.0\nParameters\n";
  const auto said = [&](const std::string& from, const std::string& to) {
    std::string text = utm10;
    text.replace(text.find(from), from.size(), to);
    SpillFile(dir_ / "dem.prj", text);
    Result<Dem> dem = ReadDem(Tiff(kUsual), {});
    return dem && Says(*dem, "prj-file");
  };
  EXPECT_FALSE(said("Zone 10", "Zone 10"));
  EXPECT_TRUE(said("Zone 10", "Zone 11"));
  EXPECT_TRUE(said("Zunits METERS", "Zunits FEET"));
}

TEST_F(RasterPlace, APrjBesideIsReadAndSaidUnlessTheCallStatesASystem) {
  const std::filesystem::path path = Tiff(kUsual, "");
  SpillFile(dir_ / "dem.prj",
            "PROJCS[\"WGS_1984_UTM_Zone_10N\",GEOGCS[\"GCS_WGS_1984\",DATUM[\"D_WGS_1984\","
            "SPHEROID[\"WGS_1984\",6378137.0,298.257223563]],PRIMEM[\"Greenwich\",0.0],"
            "UNIT[\"Degree\",0.0174532925199433]],PROJECTION[\"Transverse_Mercator\"],"
            "PARAMETER[\"False_Easting\",500000.0],PARAMETER[\"False_Northing\",0.0],"
            "PARAMETER[\"Central_Meridian\",-123.0],PARAMETER[\"Scale_Factor\",0.9996],"
            "PARAMETER[\"Latitude_Of_Origin\",0.0],UNIT[\"Meter\",1.0]]");
  Result<Dem> dem = ReadDem(path, {});
  ASSERT_TRUE(dem) << dem.error().message;
  EXPECT_THAT(dem->crs, HasSubstr("UTM"));
  EXPECT_TRUE(Says(*dem, "prj-file"));
  Result<Dem> stated = ReadDem(path, {.crs = "EPSG:26910"});
  ASSERT_TRUE(stated) << stated.error().message;
  EXPECT_EQ(stated->crs, "EPSG:26910");
  EXPECT_FALSE(Says(*stated, "prj-file"));
  SpillFile(dir_ / "dem.prj", "north");
  Result<Dem> none = ReadDem(path, {});
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().kind, "no-crs");
  EXPECT_THAT(none.error().message, HasSubstr("dem.prj"));
}

}  // namespace
}  // namespace farhorizon

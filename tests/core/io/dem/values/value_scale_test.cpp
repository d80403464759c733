// Units, directions and vertical datums of rasters of 3 x 2 posts with the values 1 to 6.
#include "core/io/dem/values/value_scale.h"

#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/dem/read_dem.h"
#include "tests/support/temp_dir.h"
#include "tests/support/test_raster.h"

namespace farhorizon {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double kFeet = 0.3048;
constexpr double kSurveyFeet = 1200.0 / 3937;
constexpr char kEgm96InFeet[] =
    "VERTCRS[\"EGM96 height\",VDATUM[\"EGM96 geoid\"],CS[vertical,1],AXIS[\"up\",up],"
    "LENGTHUNIT[\"foot\",0.3048]]";

// Changes EPSG's code of the unit of heights that a little-endian TIFF has (VerticalUnitsGeoKey).
void SetVerticalUnits(const std::filesystem::path& path, int code) {
  std::string bytes = SlurpFile(path);
  const std::string key = {3, 16, 0, 0, 1, 0};  // 4099, no tag, one value
  const std::size_t at = bytes.find(key);
  if (at == std::string::npos) throw std::runtime_error("no VerticalUnitsGeoKey");
  bytes[at + 6] = static_cast<char>(code & 0xFF);
  bytes[at + 7] = static_cast<char>(code >> 8);
  SpillFile(path, bytes);
}

class ValueScaleOf : public ::testing::Test {
 protected:
  Dem Read(const TestRaster& raster, const DemReadOptions& options = {}) {
    WriteTiff(dir_ / "dem.tif", raster);
    return ReadAgain(options);
  }

  Dem ReadAgain(const DemReadOptions& options = {}) {
    Result<Dem> dem = ReadDem(dir_ / "dem.tif", options);
    if (!dem) throw std::runtime_error(dem.error().message);
    codes_.clear();
    text_.clear();
    for (const Assumption& assumption : dem->assumptions) {
      codes_.push_back(assumption.code);
      text_ += assumption.text + "\n";
    }
    return *dem;
  }

  // The last post's height, whose value is 6; what was assumed is in codes_ and text_.
  double Last(const TestRaster& raster, const DemReadOptions& options = {}) {
    return Read(raster, options).HeightM(5);
  }

  TempDir dir_;
  std::vector<std::string> codes_;
  std::string text_;
};

TEST_F(ValueScaleOf, AFileThatStatesAllAssumesNothing) {
  EXPECT_EQ(Last({.crs = "EPSG:32610+5773"}), 6);
  EXPECT_THAT(codes_, IsEmpty());
  EXPECT_EQ(Last({.crs = "EPSG:32610", .unit = "m"}, {.vertical_datum = "ellipsoid"}), 6);
  EXPECT_THAT(codes_, IsEmpty());
  EXPECT_NEAR(Last({.crs = "EPSG:26910+6360"}), 6 * kSurveyFeet, 1e-9);
  EXPECT_THAT(codes_, IsEmpty());
}

TEST_F(ValueScaleOf, SaysUnitAndDatumWhereNothingIsSaid) {
  EXPECT_EQ(Last({.crs = "EPSG:32610"}), 6);
  EXPECT_THAT(codes_, ElementsAre("height-unit", "vertical-datum"));
  EXPECT_THAT(text_, AllOf(HasSubstr("--height-unit"), HasSubstr("--vertical-datum")));
  EXPECT_EQ(Last({.crs = "EPSG:32610"}, {.vertical_datum = "ellipsoid", .height_unit = "m"}), 6);
  EXPECT_THAT(codes_, IsEmpty());
}

TEST_F(ValueScaleOf, SaysThatTheMapOfAStatePlaneIsInFeet) {
  const TestRaster raster = {.geotransform = std::array<double, 6>{1640000, 25, 0, 1700000, 0, -25},
                             .crs = "EPSG:6529"};
  EXPECT_EQ(Last(raster), 6);
  EXPECT_THAT(text_, AllOf(HasSubstr("US survey foot"), HasSubstr("--height-unit")));
  EXPECT_NEAR(Last(raster, {.height_unit = "us-ft"}), 6 * kSurveyFeet, 1e-9);
  EXPECT_THAT(codes_, ElementsAre("vertical-datum"));
}

TEST_F(ValueScaleOf, TheUnitOfTheCallsSystemCounts) {
  EXPECT_NEAR(Last({.crs = "EPSG:32610"}, {.vertical_datum = kEgm96InFeet}), 6 * kFeet, 1e-9);
  EXPECT_THAT(codes_, IsEmpty());
  EXPECT_NEAR(Last({.crs = "EPSG:32610"}, {.crs = "EPSG:26910+6360"}), 6 * kSurveyFeet, 1e-9);
  EXPECT_THAT(codes_, IsEmpty());
  EXPECT_NEAR(Last({.crs = "EPSG:32610"}, {.crs = "+proj=utm +zone=10 +datum=WGS84 +vunits=ft"}),
              6 * kFeet, 1e-9);
  // The file's vertical system is in metres: it is what the call has set right.
  EXPECT_NEAR(Last({.crs = "EPSG:32610+5773"}, {.vertical_datum = kEgm96InFeet}), 6 * kFeet, 1e-9);
  EXPECT_THAT(codes_, ElementsAre("height-unit"));
}

TEST_F(ValueScaleOf, ADatumInMetresMakesNoMetresOfFeet) {
  EXPECT_NEAR(Last({.unit = "US survey foot"}, {.vertical_datum = "EPSG:5773"}), 6 * kSurveyFeet,
              1e-9);
  EXPECT_THAT(codes_, ElementsAre("height-unit"));
  EXPECT_NEAR(Last({.crs = "EPSG:26910+6360"}, {.vertical_datum = "EPSG:5773"}), 6 * kSurveyFeet,
              1e-9);
  EXPECT_THAT(codes_, ElementsAre("height-unit"));
  EXPECT_NEAR(Last({.crs = "EPSG:26910+6360"}, {.vertical_datum = "ellipsoid"}), 6 * kSurveyFeet,
              1e-9);
  EXPECT_EQ(Last({.unit = "US survey foot"}, {.vertical_datum = "EPSG:5773", .height_unit = "m"}),
            6);
  EXPECT_THAT(codes_, IsEmpty());
}

// The file says EGM96 height, in metres, and VerticalUnitsGeoKey: GDAL passes over the key.
TEST_F(ValueScaleOf, AKeyInFeetCountsBeforeASystemInMetres) {
  WriteTiff(dir_ / "dem.tif", {.crs = "EPSG:32610+5773", .options = {"GEOTIFF_VERSION=1.0"}});
  const std::pair<int, double> kUnits[] = {
      {9001, 1}, {9002, kFeet}, {9003, kSurveyFeet}, {9014, 1.8288}};
  for (const auto& [code, metres] : kUnits) {
    SetVerticalUnits(dir_ / "dem.tif", code);
    EXPECT_NEAR(ReadAgain().HeightM(5), 6 * metres, 1e-9) << code;
    if (code == 9001) {
      EXPECT_THAT(codes_, IsEmpty());
      continue;
    }
    EXPECT_THAT(codes_, ElementsAre("height-unit")) << code;
    EXPECT_THAT(text_, AllOf(HasSubstr("VerticalUnitsGeoKey"), HasSubstr("EPSG:5773"),
                             HasSubstr("metre"), HasSubstr("--height-unit")));
    EXPECT_EQ(ReadAgain({.height_unit = "m"}).HeightM(5), 6) << code;  // the remedy
    EXPECT_THAT(codes_, IsEmpty());
  }
  // No unit of length, or one of the user's own.
  for (const int code : {0, 9102, 32767}) {
    SetVerticalUnits(dir_ / "dem.tif", code);
    EXPECT_EQ(ReadAgain().HeightM(5), 6) << code;
  }
}

TEST_F(ValueScaleOf, AStatedUnitTakesThePlaceOfOneThatIsNotKnown) {
  EXPECT_NEAR(Last({.unit = "m*10"}, {.height_unit = "ft"}), 6 * kFeet, 1e-9);
}

TEST_F(ValueScaleOf, ScaleAndOffsetAreInTheUnit) {
  EXPECT_NEAR(Last({.scale = 10, .offset = 5, .unit = "ft"}), 65 * kFeet, 1e-9);
}

TEST_F(ValueScaleOf, DepthsTurnTheirSignOnce) {
  for (const char* crs : {"EPSG:32610+5715", "EPSG:32610+5861"}) {
    EXPECT_EQ(Last({.crs = crs}), -6) << crs;
    EXPECT_THAT(codes_, ElementsAre("depths")) << crs;
    // Whatever is said of the datum, the file's values count down.
    EXPECT_EQ(Last({.crs = crs}, {.vertical_datum = "EPSG:5773"}), -6) << crs;
    EXPECT_EQ(Last({.crs = crs}, {.vertical_datum = "EPSG:5715"}), -6) << crs;
    EXPECT_EQ(Last({.crs = crs}, {.vertical_datum = "ellipsoid"}), -6) << crs;
    EXPECT_EQ(Last({.crs = crs}, {.crs = "EPSG:32610"}), -6) << crs;
    // The remedy of the sentence: the file's system is the wrong one.
    EXPECT_EQ(Last({.crs = crs}, {.crs = "EPSG:32610+5773"}), 6) << crs;
    EXPECT_THAT(codes_, IsEmpty()) << crs;
  }
  EXPECT_EQ(Last({.crs = "EPSG:32610"}, {.vertical_datum = "EPSG:5715"}), -6);
  EXPECT_EQ(Last({.crs = "EPSG:32610"}, {.crs = "EPSG:32610+5715"}), -6);
  EXPECT_NEAR(Last({.crs = "EPSG:26910+6358"}), -6 * kSurveyFeet, 1e-9);  // NAVD88 depth (ftUS)
}

TEST_F(ValueScaleOf, SaysThatTheFilesDatumGaveWayToTheCallsMap) {
  EXPECT_EQ(Last({.crs = "EPSG:32610+5773"}, {.crs = "EPSG:32610"}), 6);
  EXPECT_THAT(codes_, ElementsAre("vertical-datum"));
  EXPECT_THAT(text_, HasSubstr("EPSG:5773"));
}

TEST_F(ValueScaleOf, RefusesADatumThatIsNone) {
  WriteTiff(dir_ / "dem.tif", {});
  Result<Dem> dem = ReadDem(dir_ / "dem.tif", {.vertical_datum = "EPSG:4326"});
  ASSERT_FALSE(dem);
  EXPECT_EQ(dem.error().kind, "unknown-crs");
  EXPECT_THAT(dem.error().message, HasSubstr("EPSG:5773"));
}

}  // namespace
}  // namespace farhorizon

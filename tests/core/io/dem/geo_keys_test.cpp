#include "core/io/dem/geo_keys.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/dem/read_dem.h"
#include "tests/support/temp_dir.h"
#include "tests/support/test_raster.h"

namespace farhorizon {
namespace {

using ::testing::HasSubstr;

constexpr int kVerticalUnits = 4099;

// Overwrites the value of `key` in the directory of keys of a little-endian TIFF.
void SetGeoKey(const std::filesystem::path& path, int key, int value) {
  std::string bytes = SlurpFile(path);
  const auto low = static_cast<char>(key & 0xFF);
  const auto high = static_cast<char>(key >> 8);
  const std::string entry = {low, high, 0, 0, 1, 0};  // the key, no tag, one value
  const std::size_t at = bytes.find(entry);
  ASSERT_NE(at, std::string::npos);
  bytes[at + 6] = static_cast<char>(value & 0xFF);
  bytes[at + 7] = static_cast<char>(value >> 8);
  SpillFile(path, bytes);
}

class GeoKeys : public ::testing::Test {
 protected:
  // A file in `crs`, its unit of heights changed to that with EPSG's code `unit`.
  void Write(const std::string& crs, int unit) {
    WriteTiff(dir_ / "dem.tif", {.crs = crs, .options = {"GEOTIFF_VERSION=1.0"}});
    SetGeoKey(dir_ / "dem.tif", kVerticalUnits, unit);
  }
  std::optional<int> Unit() {
    std::optional<TiffFile> tiff = TiffFile::Open(dir_ / "dem.tif");
    return tiff ? VerticalUnitsKey(*tiff) : std::nullopt;
  }

  TempDir dir_;
};

TEST_F(GeoKeys, AreReadWhereGdalPassesOverThem) {
  Write("EPSG:32610+5773", 9003);
  EXPECT_EQ(Unit(), 9003);
  Result<Dem> dem = ReadDem(dir_ / "dem.tif", {});
  ASSERT_TRUE(dem) << dem.error().message;
  EXPECT_NEAR(dem->HeightM(5), 6 * 1200.0 / 3937, 1e-9);
  ASSERT_EQ(dem->assumptions.size(), 1U);
  EXPECT_EQ(dem->assumptions[0].code, "height-unit");
  EXPECT_THAT(dem->assumptions[0].text, HasSubstr("VerticalUnitsGeoKey"));
  EXPECT_THAT(dem->assumptions[0].text, HasSubstr("metre"));
  // The remedy.
  dem = ReadDem(dir_ / "dem.tif", {.height_unit = "m"});
  ASSERT_TRUE(dem);
  EXPECT_EQ(dem->HeightM(5), 6);
  EXPECT_TRUE(dem->assumptions.empty());
}

TEST_F(GeoKeys, OfAUserOrOfNoUnitSayNothing) {
  Write("EPSG:32610+5773", 32767);
  EXPECT_EQ(Unit(), std::nullopt);
  Write("EPSG:32610+5773", 0);
  EXPECT_EQ(Unit(), std::nullopt);
  Write("EPSG:32610+5773", 9102);  // degrees
  Result<Dem> dem = ReadDem(dir_ / "dem.tif", {});
  ASSERT_TRUE(dem) << dem.error().message;
  EXPECT_EQ(dem->HeightM(5), 6);
}

TEST_F(GeoKeys, AreNoneWhereTheFileHasNone) {
  WriteTiff(dir_ / "dem.tif", {.crs = ""});
  EXPECT_EQ(Unit(), std::nullopt);
}

}  // namespace
}  // namespace farhorizon

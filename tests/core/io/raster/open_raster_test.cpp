#include "core/io/raster/open_raster.h"

#include <algorithm>
#include <cstring>

#include <gdal.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/format_raster.h"
#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

using ::testing::DoubleEq;
using ::testing::HasSubstr;
using ::testing::Pointwise;

class OpenRasterTest : public ::testing::Test {
 protected:
  // The cells of a file, row by row, or a thrown error.
  std::vector<double> Cells(const std::string& name) {
    const std::filesystem::path path = dir_ / name;
    GdalSession session(path);
    Result<OpenedRaster> raster = OpenRaster(path, {1'000'000}, session);
    if (!raster) throw std::runtime_error(raster.error().message);
    const GDALDatasetH dataset = raster->dataset.get();
    const int columns = GDALGetRasterXSize(dataset);
    const int rows = GDALGetRasterYSize(dataset);
    std::vector<double> cells(static_cast<std::size_t>(columns * rows));
    GDALGetGeoTransform(dataset, transform_.data());
    has_crs_ = GDALGetSpatialRef(dataset) != nullptr;
    if (GDALRasterIO(GDALGetRasterBand(dataset, 1), GF_Read, 0, 0, columns, rows, cells.data(),
                     columns, rows, GDT_Float64, 0, 0) != CE_None) {
      throw std::runtime_error("cells cannot be read" + session.Complaint());
    }
    return cells;
  }
  std::string Refusal(const std::string& name) {
    const std::filesystem::path path = dir_ / name;
    GdalSession session(path);
    Result<OpenedRaster> raster = OpenRaster(path, {1'000'000}, session);
    if (raster) return "opened";
    EXPECT_THAT(raster.error().message, ::testing::Not(HasSubstr(dir_.path().string())));
    return std::string(raster.error().kind) + ": " + raster.error().message;
  }
  void Spill(const std::string& name, const std::string& bytes) { SpillFile(dir_ / name, bytes); }
  void SpillBeside(const std::string& name, const std::string& bytes, const std::string& header) {
    Spill(name, bytes);
    Spill(std::filesystem::path(name).replace_extension(".hdr").string(), header);
  }

  TempDir dir_;
  std::array<double, 6> transform_{};
  bool has_crs_ = false;
};

// Each format that GDAL writes and this program reads has GDAL's cells at GDAL's place.
TEST_F(OpenRasterTest, ReadsWhatGdalWrites) {
  const TestRaster raster = DistinctHeights(7, 5);
  const struct {
    const char* name;
    const char* driver;
    std::vector<std::string> options;
    bool has_crs;
  } kWrittenByGdal[] = {{"dem.tif", "GTiff", {}, true},
                        {"dem.img", "HFA", {}, true},
                        {"packed.img", "HFA", {"COMPRESSED=YES"}, true},
                        {"dem.bil", "EHdr", {}, true},
                        {"dem.flt", "EHdr", {}, true},
                        {"dem.dat", "ENVI", {}, true},
                        {"dem.asc", "AAIGrid", {}, true},
                        {"text.grd", "GSAG", {}, false},
                        {"binary.grd", "GSBG", {}, false},
                        {"seven.grd", "GS7BG", {}, false},
                        {"dem.xyz", "XYZ", {}, false},
                        {"comma.csv", "XYZ", {"COLUMN_SEPARATOR=,"}, false},
                        {"named.xyz", "XYZ", {"ADD_HEADER_LINE=YES"}, false}};
  for (const auto& format : kWrittenByGdal) {
    WriteWithDriver(dir_ / format.name, format.driver, raster, format.options);
    EXPECT_THAT(Cells(format.name), Pointwise(DoubleEq(), raster.values)) << format.name;
    EXPECT_THAT(transform_, Pointwise(::testing::DoubleNear(1e-6), *raster.geotransform))
        << format.name;
    EXPECT_EQ(has_crs_, format.has_crs) << format.name;
  }
}

TEST_F(OpenRasterTest, RefusesFilesThatAreCutShort) {
  const TestRaster raster = DistinctHeights(30, 20);
  for (const auto& [name, driver] :
       {std::pair("dem.img", "HFA"), std::pair("dem.bil", "EHdr"), std::pair("dem.asc", "AAIGrid"),
        std::pair("a.grd", "GSAG"), std::pair("b.grd", "GSBG"), std::pair("c.grd", "GS7BG")}) {
    WriteWithDriver(dir_ / name, driver, raster);
    const std::string whole = SlurpFile(dir_ / name);
    for (const std::size_t part : {2, 5, 9}) {
      Spill(name, whole.substr(0, whole.size() * part / 10));
      EXPECT_THROW(Cells(name), std::runtime_error) << name << " " << part;
    }
  }
}

// The cells of such a raster are in a file whose name is in the raster: any file's, if it is
// hostile.
TEST_F(OpenRasterTest, FollowsNoNameInAnErdasFile) {
  WriteWithDriver(dir_ / "dem.img", "HFA", DistinctHeights(30, 20), {"USE_SPILL=YES"});
  ASSERT_TRUE(std::filesystem::exists(dir_ / "dem.ige"));
  EXPECT_THAT(Refusal("dem.img"), HasSubstr("gdal_translate IN.img OUT.tif"));
}

TEST_F(OpenRasterTest, ReadsTheNumbersThatAHeaderDescribes) {
  const std::string header =
      "nrows 2\nncols 3\nnbits 16\nbyteorder I\nulxmap 10\nulymap 20\nxdim 2\nydim 2\n";
  const std::string cells("\1\0\2\0\3\0\4\0\5\0\6\0", 12);
  SpillBeside("dem.bil", cells, header);
  EXPECT_THAT(Cells("dem.bil"), ::testing::ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_THAT(transform_, ::testing::ElementsAre(9, 2, 0, 21, 0, -2));
  Spill("DEM2.FLT", std::string("\0\0\x80\x3f\0\0\0\x40\0\0\x80\x3f\0\0\0\x40", 16));
  Spill("DEM2.HDR",
        "ncols 2\nnrows 2\nxllcenter 10\nyllcenter 20\ncellsize 2\nbyteorder LSBFIRST\n");
  EXPECT_THAT(Cells("DEM2.FLT"), ::testing::ElementsAre(1, 2, 1, 2));
  EXPECT_THAT(transform_, ::testing::ElementsAre(9, 2, 0, 23, 0, -2));
  EXPECT_THAT(Refusal("dem.hdr"), HasSubstr("give the raster itself, \"dem.bil\""));
  SpillBeside("bad.bil", cells, "hello\n");
  EXPECT_THAT(Refusal("bad.bil"), HasSubstr("ncols"));
  Spill("alone.bil", cells);
  EXPECT_THAT(Refusal("alone.bil"), HasSubstr("header (.hdr) is not beside it"));
}

TEST_F(OpenRasterTest, ReadsTheReferenceSystemBesideATextGrid) {
  Spill("dem.asc", "ncols 2\nnrows 2\nxllcorner 3600\nyllcorner 7200\ncellsize 3600\n1 2\n3 4\n");
  Cells("dem.asc");
  EXPECT_FALSE(has_crs_);
  Spill("dem.prj", "Projection GEOGRAPHIC\nDatum WGS84\nUnits DS\nZunits METERS\nParameters\n");
  Cells("dem.asc");
  EXPECT_TRUE(has_crs_);
  EXPECT_THAT(transform_, ::testing::ElementsAre(1, 1, 0, 4, 0, -1));
}

TEST_F(OpenRasterTest, SaysHowTheColumnsOfAListWereTaken) {
  Spill("list.xyz", "10 20 1\n12 20 2\n10 22 3\n12 22 4\n");
  Spill("named.xyz", "y x z\n20 10 1\n20 12 2\n22 10 3\n22 12 4\n");
  for (const auto& [name, codes] : {std::pair("list.xyz", 1), std::pair("named.xyz", 0)}) {
    EXPECT_THAT(Cells(name), ::testing::ElementsAre(3, 4, 1, 2));
    GdalSession session(dir_ / name);
    Result<OpenedRaster> raster = OpenRaster(dir_ / name, {100}, session);
    ASSERT_TRUE(raster);
    EXPECT_EQ(std::ranges::count(raster->assumptions, "xyz-order", &Assumption::code), codes)
        << name;
  }
}

// A stored (not deflated) archive of one member; checksums are read only at a member's end.
std::string ZipOf(const std::string& name, const std::string& bytes, std::uint32_t claimed) {
  const auto number = [](std::uint64_t value, int width) {
    std::string text;
    for (int i = 0; i < width; ++i) text += static_cast<char>(value >> (8 * i) & 0xffU);
    return text;
  };
  const std::string sizes = number(0, 4) + number(static_cast<std::uint32_t>(bytes.size()), 4) +
                            number(claimed, 4) +
                            number(static_cast<std::uint32_t>(name.size()), 2) + number(0, 2);
  const std::string head = number(20, 2) + number(0, 2) + number(0, 2) + number(0, 4) + sizes;
  const std::string local = "PK\x03\x04" + head + name + bytes;
  const std::string central =
      "PK\x01\x02" + number(20, 2) + head + number(0, 6) + number(0, 4) + number(0, 4) + name;
  return local + central + "PK\x05\x06" + number(0, 4) + number(1, 2) + number(1, 2) +
         number(static_cast<std::uint32_t>(central.size()), 4) +
         number(static_cast<std::uint32_t>(local.size()), 4) + number(0, 2);
}

TEST_F(OpenRasterTest, ReadsAZippedHgt) {
  std::string tile(2 * 1201 * 1201, '\0');
  tile[1] = 42;
  const auto size = static_cast<std::uint32_t>(tile.size());
  Spill("N46E007.hgt.zip", ZipOf("N46E007.hgt", tile, size));
  EXPECT_EQ(Cells("N46E007.hgt.zip")[0], 42);
  EXPECT_NEAR(transform_[0], 7 - 0.5 / 1200, 1e-12);
  Spill("N46E007.hgt.zip", ZipOf("dem.hgt", tile, size));
  EXPECT_THAT(Refusal("N46E007.hgt.zip"), HasSubstr("known by its name"));
  Spill("N46E007.hgt.zip", ZipOf("N46E007.tif", tile, size));
  EXPECT_THAT(Refusal("N46E007.hgt.zip"), HasSubstr("0 HGT files"));
  Spill("N46E007.hgt.zip", ZipOf("N46E007.hgt", "ab", 4'000'000'000U));
  EXPECT_THAT(Refusal("N46E007.hgt.zip"), HasSubstr("truncated"));
  std::string damaged = ZipOf("N46E007.hgt", tile, size);
  damaged[8] = 99;  // the member's own header names an unknown compression, the list does not
  Spill("N46E007.hgt.zip", damaged);
  EXPECT_THAT(Refusal("N46E007.hgt.zip"), HasSubstr("damaged"));
  Spill("N46E007.hgt.zip", "PK\x03\x04 and no archive");
  EXPECT_THAT(Refusal("N46E007.hgt.zip"), HasSubstr("0 HGT files"));
}

TEST_F(OpenRasterTest, SaysWhatIsNoFile) {
  EXPECT_THAT(Refusal("nowhere.tif"), HasSubstr("there is no file \"nowhere.tif\""));
  std::filesystem::create_directory(dir_ / "grid");
  EXPECT_THAT(Refusal("grid"), HasSubstr("is a folder"));
  const std::filesystem::path address = "https://example.org/dem.tif";
  GdalSession session(address);
  Result<OpenedRaster> raster = OpenRaster(address, {100}, session);
  ASSERT_FALSE(raster);
  EXPECT_THAT(raster.error().message, HasSubstr("it is an address"));
}

TEST_F(OpenRasterTest, SaysWhatAFileIs) {
  Spill("dem.nc", "CDF\x01");
  EXPECT_THAT(Refusal("dem.nc"), HasSubstr("\"dem.nc\" is a netCDF file; take its heights out"));
  Spill("dem.tif", "II*");
  EXPECT_THAT(Refusal("dem.tif"), HasSubstr("TIFF that cannot be opened"));
  Spill("N46E007 (1).hgt", std::string(2 * 1201 * 1201, '\0'));
  EXPECT_THAT(Refusal("N46E007 (1).hgt"), HasSubstr("known by its name"));
}

}  // namespace
}  // namespace farhorizon

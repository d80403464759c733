#include "core/io/dem/read_dem.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/dem_fixture.h"

namespace farhorizon {
namespace {

using ::testing::ElementsAre;

class DemReader : public DemFixture {
 protected:
  std::string KindOfText(const std::string& name, const std::string& text) {
    SpillFile(dir_ / name, text);
    return KindOf(ReadDem(dir_ / name, {}));
  }
};

constexpr char kEnviHeader[] =
    "ENVI\nsamples = 3\nlines = 2\nbands = 1\nheader offset = 0\nfile type = ENVI Standard\n"
    "data type = 2\ninterleave = bsq\nbyte order = 0\n"
    "map info = {UTM, 1, 1, 500000, 5100000, 30, 30, 10, North, WGS-84}\n";

TEST_F(DemReader, WholeHeightsStayAsTheyAre) {
  const Dem dem = MustRead({});
  EXPECT_EQ(dem.columns, 3);
  EXPECT_EQ(dem.rows, 2);
  EXPECT_THAT(dem.heights, ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_EQ(dem.quantum_m, 1);
  EXPECT_EQ(dem.height_offset_m, 0);
  EXPECT_FALSE(dem.quantized);
  EXPECT_EQ(dem.crs, "EPSG:32610");
}

TEST_F(DemReader, PostsAreCellCentres) {
  const Dem dem = MustRead({});
  EXPECT_EQ(dem.transform.origin_x, 500015);
  EXPECT_EQ(dem.transform.origin_y, 5099985);
  EXPECT_EQ(dem.transform.step_x, 30);
  EXPECT_EQ(dem.transform.step_y, -30);
}

// GDAL returns corners for PixelIsPoint files, too: the written transform, with the post half a
// cell inside.
TEST_F(DemReader, PixelIsPointFilesHaveTheirPostsInThePlaceOfThePixels) {
  const Dem dem = MustRead({.metadata = {{"AREA_OR_POINT", "Point"}}});
  EXPECT_EQ(dem.transform.origin_x, 500015);
  EXPECT_EQ(dem.transform.origin_y, 5099985);
}

TEST_F(DemReader, SouthUpRowsStayInTheirOrder) {
  const Dem dem = MustRead({.geotransform = {{500000, 30, 0, 5100000, 0, 30}}});
  EXPECT_EQ(dem.transform.step_y, 30);
  EXPECT_EQ(dem.transform.origin_y, 5100015);
  EXPECT_THAT(dem.heights, ElementsAre(1, 2, 3, 4, 5, 6));
}

TEST_F(DemReader, EveryRealTypeIsRead) {
  for (const char* type :
       {"Byte", "UInt16", "Int16", "UInt32", "Int32", "UInt64", "Int64", "Float32", "Float64"}) {
    const Dem dem = MustRead({.type = type});
    EXPECT_THAT(dem.heights, ElementsAre(1, 2, 3, 4, 5, 6)) << type;
  }
}

TEST_F(DemReader, FractionsBecomeMultiplesOfAPowerOfTwo) {
  const Dem dem = MustRead({.type = "Float32", .values = {1.5, -2.25, 3, 4, 5, 6}});
  EXPECT_EQ(dem.quantum_m, 0.25);
  EXPECT_THAT(dem.heights, ElementsAre(6, -9, 12, 16, 20, 24));
  EXPECT_FALSE(dem.quantized);
}

TEST_F(DemReader, FractionsTooFineForThirtyBitsAreRoundedAndSaidToBe) {
  const std::vector<double> values = {0.1, 1000.3, 3, 4, 5, 6};
  const Dem dem = MustRead({.type = "Float64", .values = values});
  EXPECT_TRUE(dem.quantized);
  for (std::size_t i = 0; i < values.size(); ++i) {
    EXPECT_LE(std::abs(dem.HeightM(static_cast<VertexId>(i)) - values[i]), dem.quantum_m / 2);
    EXPECT_LT(std::abs(dem.heights[i]), 1 << 30);
  }
}

TEST_F(DemReader, NodataAndNanAreNoHeight) {
  const Dem dem =
      MustRead({.type = "Float32", .values = {-9999, 2, kNan, 4, 5, 6}, .nodata = -9999});
  EXPECT_THAT(dem.heights, ElementsAre(kNoHeight, 2, kNoHeight, 4, 5, 6));
}

TEST_F(DemReader, NodataBeyondFloatsDigitsIsRecognised) {
  for (const double nodata : {-1e37, -3.40282e+38, -3.4028234663852886e+38, 1.7e308}) {
    const double stored = std::clamp<double>(nodata, std::numeric_limits<float>::lowest(),
                                             std::numeric_limits<float>::max());
    DemReadOptions options;
    options.nodata = {std::abs(nodata) > 1e300 ? stored : nodata};
    const Dem dem = MustRead({.type = "Float32", .values = {stored, 2, 3, 4, 5, 6}}, options);
    EXPECT_THAT(dem.heights, ElementsAre(kNoHeight, 2, 3, 4, 5, 6)) << nodata;
  }
}

TEST_F(DemReader, NodataOutsideTheTypeMatchesNothing) {
  const Dem dem = MustRead({.type = "UInt16"}, {.nodata = {-9999}});
  EXPECT_THAT(dem.heights, ElementsAre(1, 2, 3, 4, 5, 6));
}

TEST_F(DemReader, AnInternalMaskHidesPosts) {
  const Dem dem = MustRead({.mask = {1, 0, 1, 1, 1, 0}});
  EXPECT_THAT(dem.heights, ElementsAre(1, kNoHeight, 3, 4, 5, kNoHeight));
}

TEST_F(DemReader, ScaleOffsetAndFeetGoIntoQuantumAndOffset) {
  const Dem dem = MustRead({.scale = 0.5, .offset = 100, .unit = "ft"});
  EXPECT_THAT(dem.heights, ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_DOUBLE_EQ(dem.quantum_m, 0.5 * 0.3048);
  EXPECT_DOUBLE_EQ(dem.HeightM(5), (6 * 0.5 + 100) * 0.3048);
}

TEST_F(DemReader, ANegativeScaleKeepsTheQuantumPositive) {
  const Dem dem = MustRead({.scale = -2});
  EXPECT_EQ(dem.quantum_m, 2);
  EXPECT_THAT(Metres(dem), ElementsAre(-2, -4, -6, -8, -10, -12));
}

TEST_F(DemReader, TheVerticalUnitOfTheReferenceSystemCounts) {
  const Dem dem = MustRead({.crs = "EPSG:32610+6360"});  // NAVD88 height (ftUS)
  EXPECT_DOUBLE_EQ(dem.quantum_m, 1200.0 / 3937);
}

TEST_F(DemReader, ReferenceSystemOfTheCallReplacesTheFiles) {
  EXPECT_EQ(MustRead({}, {.crs = "EPSG:26910"}).crs, "EPSG:26910");
  EXPECT_EQ(MustRead({.crs = ""}, {.crs = "EPSG:26910"}).crs, "EPSG:26910");
}

TEST_F(DemReader, ReadingLeavesNothingBehind) {
  ASSERT_TRUE(Read({}));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(dir_.path()), {}), 1);
}

TEST_F(DemReader, AsciiGridsAreRead) {
  SpillFile(dir_ / "dem.asc",
            "ncols 3\nnrows 2\nxllcorner 10\nyllcorner 20\ncellsize 2\nNODATA_value -9999\n"
            "1 2 3\n4 -9999 6.5\n");
  Result<Dem> dem = ReadDem(dir_ / "dem.asc", {.crs = "EPSG:32610"});
  ASSERT_TRUE(dem) << dem.error().message;
  EXPECT_THAT(dem->heights, ElementsAre(2, 4, 6, 8, kNoHeight, 13));
  EXPECT_EQ(dem->quantum_m, 0.5);
  EXPECT_EQ(dem->transform.origin_x, 11);
  EXPECT_EQ(dem->transform.origin_y, 23);
}

TEST_F(DemReader, EnviRastersAreReadWithTheirHeader) {
  SpillFile(dir_ / "dem.img", std::string("\1\0\2\0\3\0\4\0\5\0\6\0", 12));
  SpillFile(dir_ / "dem.hdr", kEnviHeader);
  Result<Dem> dem = ReadDem(dir_ / "dem.img", {});
  ASSERT_TRUE(dem) << dem.error().message;
  EXPECT_THAT(dem->heights, ElementsAre(1, 2, 3, 4, 5, 6));
}

// A tile of SRTM3: 1201 x 1201, big-endian, its place in its name.
TEST_F(DemReader, SrtmTilesAreRead) {
  std::string bytes(1201 * 1201 * 2, '\0');
  bytes[1] = 42;
  bytes[2] = '\x80';  // -32768
  SpillFile(dir_ / "N46E007.hgt", bytes);
  Result<Dem> dem = ReadDem(dir_ / "N46E007.hgt", {});
  ASSERT_TRUE(dem) << dem.error().message;
  EXPECT_EQ(dem->columns, 1201);
  EXPECT_EQ(dem->heights[0], 42);
  EXPECT_EQ(dem->heights[1], kNoHeight);
  EXPECT_NEAR(dem->transform.origin_x, 7, 1e-12);
  EXPECT_NEAR(dem->transform.origin_y, 47, 1e-12);
}

TEST_F(DemReader, RefusesAMissingFile) {
  Result<Dem> dem = ReadDem(dir_ / "nowhere.tif", {});
  ASSERT_FALSE(dem);
  EXPECT_EQ(dem.error().code, ErrorCode::kNotFound);
  EXPECT_FALSE(ReadDem("/vsizip/x.zip/dem.tif", {}));
  const Result<Dem> nameless = ReadDem("", {});
  ASSERT_FALSE(nameless);
  EXPECT_EQ(nameless.error().code, ErrorCode::kNotFound);
}

TEST_F(DemReader, RefusesWhatIsNoRaster) {
  EXPECT_EQ(KindOfText("dem.tif", "hello"), "not-a-raster");
  EXPECT_EQ(KindOfText("empty.tif", ""), "not-a-raster");
}

TEST_F(DemReader, RefusesARasterThatPointsElsewhere) {
  WriteTiff(dir_ / "secret.tif", {});
  EXPECT_EQ(KindOfText("dem.tif",
                       "<VRTDataset rasterXSize=\"3\" rasterYSize=\"2\"><VRTRasterBand "
                       "dataType=\"Int16\" band=\"1\"><SimpleSource><SourceFilename>" +
                           (dir_ / "secret.tif").string() +
                           "</SourceFilename><SourceBand>1</SourceBand></SimpleSource>"
                           "</VRTRasterBand></VRTDataset>"),
            "not-a-raster");
}

TEST_F(DemReader, RefusesSeveralBands) { EXPECT_EQ(KindOfTiff({.bands = 3}), "several-bands"); }

TEST_F(DemReader, RefusesARasterWithoutReferenceSystem) {
  EXPECT_EQ(KindOfTiff({.crs = ""}), "no-crs");
}

TEST_F(DemReader, RefusesRotation) {
  EXPECT_EQ(KindOfTiff({.geotransform = {{500000, 30, 1, 5100000, 0, -30}}}),
            "rotated-geotransform");
}

TEST_F(DemReader, RefusesDegenerateGeotransforms) {
  EXPECT_EQ(KindOfTiff({.geotransform = std::nullopt}), "degenerate-geotransform");
  EXPECT_EQ(KindOfTiff({.geotransform = {{500000, kNan, 0, 5100000, 0, -30}}}),
            "degenerate-geotransform");
  EXPECT_EQ(KindOfTiff({.geotransform = {{500000, 1e-12, 0, 5100000, 0, -1e-12}}}),
            "degenerate-geotransform");
}

TEST_F(DemReader, RefusesASingleLine) {
  EXPECT_EQ(KindOfTiff({.columns = 6, .rows = 1}), "too-small");
  EXPECT_EQ(KindOfTiff({.columns = 1, .rows = 6}), "too-small");
}

TEST_F(DemReader, RefusesARasterWithoutData) {
  EXPECT_EQ(KindOfTiff({.values = {7, 7, 7, 7, 7, 7}, .nodata = 7}), "all-nodata");
  EXPECT_EQ(KindOfTiff({.type = "Float32", .values = std::vector<double>(6, kNan)}), "all-nodata");
}

TEST_F(DemReader, RefusesInfiniteHeights) {
  EXPECT_EQ(KindOfTiff({.type = "Float32", .values = {1, 2, kInfinity, 4, 5, 6}}),
            "infinite-height");
  EXPECT_EQ(KindOfTiff({.type = "Float32", .values = {1, -kInfinity, 3, 4, 5, 6}}),
            "infinite-height");
}

TEST_F(DemReader, RefusesComplexNumbersAndPictures) {
  EXPECT_EQ(KindOfTiff({.type = "CFloat32"}), "unsupported-type");
  EXPECT_EQ(KindOfTiff({.type = "Byte", .colour_table = true}), "unsupported-type");
}

TEST_F(DemReader, RefusesUnitsThatAreNoLength) {
  EXPECT_EQ(KindOfTiff({.unit = "kelvin"}), "unknown-unit");
}

TEST_F(DemReader, RefusesAZeroScale) { EXPECT_EQ(KindOfTiff({.scale = 0}), "unsupported-type"); }

TEST_F(DemReader, RefusesARasterOverTheLimitWithoutReadingIt) {
  EXPECT_EQ(KindOfTiff({}, {.max_posts = 5}), "raster-too-large");
  // 10^10 sparse posts in a few hundred bytes: reading it would take minutes.
  EXPECT_EQ(KindOfTiff({.columns = 100000,
                        .rows = 100000,
                        .values = {},
                        .options = {"SPARSE_OK=TRUE", "TILED=YES", "BIGTIFF=YES"}}),
            "raster-too-large");
  EXPECT_EQ(KindOfTiff({.columns = 40000, .rows = 2, .values = std::vector<double>(80000, 1)}),
            "raster-too-large");
}

TEST_F(DemReader, RefusesBlocksThatDwarfTheRaster) {
  EXPECT_EQ(KindOfTiff({.values = {},
                        .options = {"SPARSE_OK=TRUE", "TILED=YES", "BLOCKXSIZE=16384",
                                    "BLOCKYSIZE=16384", "COMPRESS=DEFLATE"}}),
            "block-too-large");
  // As large as the raster, but a block of 64 million posts is a few hundred bytes of LERC.
  EXPECT_EQ(KindOfTiff({.columns = 8000,
                        .rows = 8000,
                        .values = {},
                        .options = {"SPARSE_OK=TRUE", "BLOCKYSIZE=8000", "COMPRESS=DEFLATE"}}),
            "block-too-large");
}

TEST_F(DemReader, BlocksLeftOutOfASparseFileWithNodataAreNoData) {
  TestRaster sparse = {.columns = 64, .rows = 64, .values = {}, .nodata = -1};
  sparse.options = {"SPARSE_OK=TRUE"};
  EXPECT_EQ(KindOfTiff(sparse), "all-nodata");
}

TEST_F(DemReader, RefusesATiffThatIsCutShortAnywhere) {
  for (const char* compression : {"COMPRESS=NONE", "COMPRESS=DEFLATE"}) {
    std::vector<double> values(64 * 64);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>(i * 37 % 1000);
    WriteTiff(dir_ / "whole.tif",
              {.columns = 64, .rows = 64, .values = values, .options = {compression}});
    const std::string whole = SlurpFile(dir_ / "whole.tif");
    for (std::size_t part = 1; part < 40; ++part) {
      SpillFile(dir_ / "cut.tif", whole.substr(0, whole.size() * part / 40));
      const std::string kind = KindOf(ReadDem(dir_ / "cut.tif", {}));
      EXPECT_THAT(kind, ::testing::AnyOf("truncated", "not-a-raster")) << compression << part;
    }
  }
}

TEST_F(DemReader, RefusesADeflateStreamThatIsDamaged) {
  std::vector<double> values(64 * 64);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>(i * i % 977);
  WriteTiff(dir_ / "dem.tif",
            {.columns = 64, .rows = 64, .values = values, .options = {"COMPRESS=DEFLATE"}});
  std::string bytes = SlurpFile(dir_ / "dem.tif");
  for (std::size_t i = bytes.size() / 2; i < bytes.size() / 2 + 64; ++i) bytes[i] = '\xff';
  SpillFile(dir_ / "dem.tif", bytes);
  EXPECT_EQ(KindOf(ReadDem(dir_ / "dem.tif", {})), "truncated");
}

constexpr char kAsciiHeader[] = "ncols 3\nnrows 2\nxllcorner 10\nyllcorner 20\ncellsize 2\n";

TEST_F(DemReader, RefusesAnAsciiGridThatIsCutShort) {
  EXPECT_EQ(KindOfText("dem.asc", kAsciiHeader + std::string("1 2 3\n4 5\n")), "truncated");
  EXPECT_EQ(KindOfText("dem.asc", kAsciiHeader + std::string("1 2 3\n4 5 6")), "no-crs");
}

TEST_F(DemReader, RefusesWordsInAnAsciiGrid) {
  EXPECT_EQ(KindOfText("dem.asc", kAsciiHeader + std::string("1 2 3\n4 five 6\n")), "not-a-raster");
}

TEST_F(DemReader, RefusesAnEnviRasterThatIsCutShort) {
  SpillFile(dir_ / "dem.img", std::string("\1\0\2\0\3\0\4\0", 8));
  SpillFile(dir_ / "dem.hdr", kEnviHeader);
  EXPECT_EQ(KindOf(ReadDem(dir_ / "dem.img", {})), "truncated");
}

TEST_F(DemReader, RefusesADtedFileThatIsCutShort) {
  const std::filesystem::path whole = std::filesystem::path(FARHORIZON_DEM_DIR) / "ontario_n43.dt0";
  if (!std::filesystem::exists(whole)) GTEST_SKIP() << "no ontario_n43.dt0 in FARHORIZON_DEM_DIR";
  const std::string bytes = SlurpFile(whole);
  EXPECT_THAT(KindOfText("n43.dt0", bytes.substr(0, bytes.size() - 100)),
              ::testing::AnyOf("truncated", "not-a-raster"));
  EXPECT_THAT(KindOfText("n43.dt0", bytes.substr(0, bytes.size() / 2)),
              ::testing::AnyOf("truncated", "not-a-raster"));
}

}  // namespace
}  // namespace farhorizon

#include "core/io/dem/tiff/tiff_blocks.h"

#include "tests/support/dem_fixture.h"

namespace farhorizon {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

class TiffBlocks : public DemFixture {
 protected:
  // 64 x 64 posts in 16 tiles, of which all but the last row of tiles are 0.
  static TestRaster Sea(std::optional<double> nodata = {}) {
    std::vector<double> values(64 * 64, 0);
    for (std::size_t i = 48 * 64; i < values.size(); ++i)
      values[i] = 2 + static_cast<double>(i % 5);
    return {.columns = 64,
            .rows = 64,
            .values = values,
            .nodata = nodata,
            .options = {"SPARSE_OK=TRUE", "TILED=YES", "BLOCKXSIZE=16", "BLOCKYSIZE=16"}};
  }
};

TEST_F(TiffBlocks, LeftOutOfAFileWithoutNodataAreZerosAndSaid) {
  const Dem dem = MustRead(Sea());
  EXPECT_EQ(PostsWithoutData(dem), 0);
  EXPECT_EQ(dem.heights[0], 0);
  std::string said;
  for (const Assumption& a : dem.assumptions) said += a.code == "absent-blocks" ? a.text : "";
  EXPECT_THAT(said, HasSubstr("12 of the file's 16 blocks"));
}

TEST_F(TiffBlocks, LeftOutOfAFileWithNodataAreNoData) {
  TestRaster sea = Sea(-1);
  for (double& value : sea.values) value = value == 0 ? -1 : value;
  const Dem dem = MustRead(sea);
  EXPECT_EQ(PostsWithoutData(dem), 48 * 64);
  EXPECT_THAT(Codes(dem), Not(Contains("absent-blocks")));
}

// GDAL makes 0 of the blocks of such a file: its own tag cannot be a sample of it.
TEST_F(TiffBlocks, LeftOutOfAFileWhoseNodataIsBesideAreNoData) {
  WriteTiff(dir_ / "dem.tif", Sea());
  SpillFile(dir_ / "dem.tif.aux.xml",
            "<PAMDataset><PAMRasterBand band=\"1\"><NoDataValue>-9999</NoDataValue>"
            "</PAMRasterBand></PAMDataset>");
  EXPECT_EQ(PostsWithoutData(Must(ReadDem(dir_ / "dem.tif", {}))), 48 * 64);
}

TEST_F(TiffBlocks, ThatAreZerosButStoredAreNothingToSay) {
  TestRaster sea = Sea();
  sea.options.erase(sea.options.begin());
  EXPECT_THAT(Codes(MustRead(sea)), Not(Contains("absent-blocks")));
}

TEST_F(TiffBlocks, OfALongStripAreNotGdalsRows) {
  std::vector<double> samples(600 * 20, 7);
  EXPECT_EQ(Must(ReadRaw({{.columns = 600, .rows = 20, .samples = samples}})).heights[599], 7);
}

TEST_F(TiffBlocks, WithAPlaceButBeyondTheEndAreCutShort) {
  TestRaster sea = Sea();
  sea.options.erase(sea.options.begin());
  WriteTiff(dir_ / "dem.tif", sea);
  const std::string bytes = SlurpFile(dir_ / "dem.tif");
  SpillFile(dir_ / "dem.tif", bytes.substr(0, bytes.size() - 100));
  EXPECT_EQ(KindOf(ReadDem(dir_ / "dem.tif", {})), "truncated");
}

TEST_F(TiffBlocks, OfBandsInPlanesOfTheirOwnAreThoseOfTheBand) {
  TestRaster raster = {.bands = 2, .type = "Float32", .options = {"ALPHA=YES", "INTERLEAVE=BAND"}};
  raster.band_values = {{1, 2, 3, 4, 5, 6}, {255, 0, 255, 255, 255, 255}};
  EXPECT_EQ(PostsWithoutData(MustRead(raster)), 1);
}

}  // namespace
}  // namespace farhorizon

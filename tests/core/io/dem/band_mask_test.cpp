#include "core/io/dem/band_mask.h"

#include "tests/support/dem_fixture.h"

namespace farhorizon {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

class BandMasks : public DemFixture {
 protected:
  static TestRaster WithAlpha(const std::vector<double>& alpha, const std::string& type) {
    TestRaster raster = {.bands = 2, .type = type, .options = {"ALPHA=YES"}};
    raster.band_values = {{1, 0, 3, 4, 5, 0}, alpha};
    return raster;
  }
};

TEST_F(BandMasks, AnAlphaBandHidesWhereItIsZero) {
  for (const char* type : {"Byte", "UInt16", "Int16", "Int32", "Float32", "Float64"}) {
    for (const double opaque : {1.0, 255.0}) {
      const Dem dem = MustRead(WithAlpha({opaque, 0, opaque, opaque, opaque, 0}, type));
      EXPECT_THAT(dem.heights, ElementsAre(1, kNoHeight, 3, 4, 5, kNoHeight)) << type;
      EXPECT_THAT(Codes(dem), Not(Contains("alpha-in-part"))) << type;
    }
  }
}

TEST_F(BandMasks, PostsThatAlphaShowsInPartAreKeptAndSaid) {
  const Dem dem = MustRead(WithAlpha({255, 0, 128, 255, 1, 0}, "Float32"));
  EXPECT_EQ(PostsWithoutData(dem), 2);
  EXPECT_THAT(Codes(dem), Contains("alpha-in-part"));
}

TEST_F(BandMasks, AnAlphaBandMayComeFirst) {
  TestRaster raster = {.bands = 2, .type = "Float32"};
  raster.band_values = {{255, 0, 255, 255, 255, 0}, {1, 0, 3, 4, 5, 0}};
  raster.alpha_band = 1;
  EXPECT_THAT(MustRead(raster).heights, ElementsAre(1, kNoHeight, 3, 4, 5, kNoHeight));
}

TEST_F(BandMasks, AMaskFileBesideHides) {
  WriteTiff(dir_ / "dem.tif", {});
  WriteTiff(dir_ / "dem.tif.msk", {.type = "Byte", .values = {255, 0, 255, 255, 0, 255}});
  const Dem dem = Must(ReadDem(dir_ / "dem.tif", {}));
  EXPECT_THAT(dem.heights, ElementsAre(1, kNoHeight, 3, 4, kNoHeight, 6));
  EXPECT_THAT(Codes(dem), Not(Contains("mask-file")));
}

TEST_F(BandMasks, AMaskFileOfAnotherSizeOrFormatIsPassedOverAndSaid) {
  WriteTiff(dir_ / "dem.tif", {});
  WriteTiff(dir_ / "dem.tif.msk", {.columns = 2, .rows = 3, .type = "Byte"});
  EXPECT_THAT(Codes(Must(ReadDem(dir_ / "dem.tif", {}))), Contains("mask-file"));
  WriteTiff(dir_ / "secret.tif", {.type = "Byte", .values = {0, 0, 0, 0, 0, 255}});
  SpillFile(dir_ / "dem.tif.msk",
            "<VRTDataset rasterXSize=\"3\" rasterYSize=\"2\"><VRTRasterBand "
            "dataType=\"Byte\" band=\"1\"><SimpleSource><SourceFilename "
            "relativeToVRT=\"1\">secret.tif</SourceFilename></SimpleSource>"
            "</VRTRasterBand></VRTDataset>");
  const Dem dem = Must(ReadDem(dir_ / "dem.tif", {}));
  EXPECT_EQ(PostsWithoutData(dem), 0);
  EXPECT_THAT(Codes(dem), Contains("mask-file"));
}

TEST_F(BandMasks, AMaskFileThatIsCutShortIsRefused) {
  std::vector<double> values(64 * 64, 1);
  WriteTiff(dir_ / "dem.tif", {.columns = 64, .rows = 64, .values = values});
  WriteTiff(dir_ / "dem.tif.msk", {.columns = 64, .rows = 64, .type = "Byte", .values = values});
  const std::string bytes = SlurpFile(dir_ / "dem.tif.msk");
  SpillFile(dir_ / "dem.tif.msk", bytes.substr(0, bytes.size() - 3000));
  EXPECT_EQ(KindOf(ReadDem(dir_ / "dem.tif", {})), "truncated");
}

}  // namespace
}  // namespace farhorizon

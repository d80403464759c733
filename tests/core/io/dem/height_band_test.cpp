#include "core/io/dem/height_band.h"

#include "tests/support/dem_fixture.h"
#include "tests/support/remedy.h"

namespace farhorizon {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

class HeightBands : public DemFixture {
 protected:
  // What the remedy with `program` makes of dem.tif.
  Dem Remedied(const Result<Dem>& refused, const std::string& program) {
    RunRemedy(MessageOf(refused), program, dir_ / "dem.tif", dir_ / "out.tif");
    return Must(ReadDem(dir_ / "out.tif", {}));
  }
};

TEST_F(HeightBands, SeveralBandsAreRefusedWithWhatTakesOneOut) {
  const Result<Dem> dem = Read({.bands = 3, .type = "Float32"});
  EXPECT_EQ(KindOf(dem), "several-bands");
  EXPECT_EQ(Metres(Remedied(dem, "gdal_translate")), (std::vector<double>{1, 2, 3, 4, 5, 6}));
}

TEST_F(HeightBands, TheRemedyForSeveralBandsKeepsAnAlphaBand) {
  TestRaster raster = {.bands = 3, .type = "Float32", .options = {"ALPHA=YES"}};
  // ALPHA=YES makes alpha of the band after the first.
  raster.band_values = {{1, 2, 3, 4, 5, 6}, {255, 0, 255, 255, 255, 0}, {7, 7, 7, 7, 7, 7}};
  const Result<Dem> dem = Read(raster);
  EXPECT_EQ(KindOf(dem), "several-bands");
  const Dem one = Remedied(dem, "gdal_translate");
  EXPECT_EQ(PostsWithoutData(one), 2);
  EXPECT_EQ(one.heights[1], kNoHeight);
}

TEST_F(HeightBands, TheRemedyForSeveralBandsKeepsAMask) {
  const Result<Dem> dem = Read({.bands = 2, .type = "Float32", .mask = {1, 0, 1, 1, 1, 1}});
  EXPECT_EQ(KindOf(dem), "several-bands");
  EXPECT_EQ(Remedied(dem, "gdal_translate").heights[1], kNoHeight);
}

// (height + 10000) * 10 in three bytes.
TEST_F(HeightBands, ColoursThatEncodeHeightsAreRefusedAndCanBeDecoded) {
  TestRaster raster = {.bands = 3, .type = "Byte", .options = {"PHOTOMETRIC=RGB"}};
  raster.band_values = {
      {1, 1, 1, 1, 1, 1}, {142, 142, 142, 142, 142, 142}, {90, 91, 92, 93, 94, 95}};
  const Result<Dem> dem = Read(raster);
  EXPECT_EQ(KindOf(dem), "several-bands");
  EXPECT_THAT(MessageOf(dem), HasSubstr("decode"));
  EXPECT_NEAR(Remedied(dem, "gdal_calc.py").HeightM(0), (65536 + 142 * 256 + 90) * 0.1 - 10000,
              0.01);
}

TEST_F(HeightBands, WiderIntegersWithAColourTableAreHeights) {
  const Dem dem =
      MustRead({.type = "UInt16", .values = {150, 2, 3, 4, 5, 650}, .colour_table = true});
  EXPECT_EQ(dem.heights[5], 650);
}

TEST_F(HeightBands, BytesWithAColourTableAreAPictureThatCanBeMadeHeights) {
  const Result<Dem> dem = Read({.type = "Byte", .colour_table = true});
  EXPECT_EQ(KindOf(dem), "unsupported-type");
  EXPECT_THAT(MessageOf(dem), HasSubstr("colour table"));
  EXPECT_EQ(Metres(Remedied(dem, "gdal_calc.py")), (std::vector<double>{1, 2, 3, 4, 5, 6}));
}

TEST_F(HeightBands, ComplexNumbersCanBeMadeHeights) {
  EXPECT_EQ(Metres(Remedied(Read({.type = "CFloat32"}), "gdal_translate")),
            (std::vector<double>{1, 2, 3, 4, 5, 6}));
}

TEST_F(HeightBands, CentimetresCanBeGivenTheirScale) {
  const Result<Dem> dem = Read({.values = {2000, 2100, 30000, 4000, 5000, 6000}});
  EXPECT_EQ(KindOf(dem), "height-out-of-range");
  EXPECT_DOUBLE_EQ(Remedied(dem, "gdal_translate").HeightM(2), 300);
}

TEST_F(HeightBands, SamplesThatWrapCanBeMadeSigned) {
  const Result<Dem> dem = Read({.type = "UInt16", .values = {65476, 65535, 3, 4, 5, 6}});
  EXPECT_EQ(KindOf(dem), "height-out-of-range");
  EXPECT_EQ(Metres(Remedied(dem, "gdal_calc.py")), (std::vector<double>{-60, -1, 3, 4, 5, 6}));
}

}  // namespace
}  // namespace farhorizon

#include "core/io/dem/tiff/tiff_file.h"

#include "tests/support/dem_fixture.h"

namespace farhorizon {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class TiffFiles : public DemFixture {
 protected:
  std::optional<TiffFile> Open(const std::string& bytes) {
    SpillFile(dir_ / "dem.tif", bytes);
    return TiffFile::Open(dir_ / "dem.tif");
  }
  const std::vector<double> samples_ = {1, 2, 3, 4, 5, 6};
};

TEST_F(TiffFiles, OfBothByteOrdersAndSizesAreRead) {
  const RawImage image = {
      .format = 2, .samples = samples_, .more = {{.tag = 42113, .type = 2, .text = "-9999"}}};
  for (const bool big_endian : {false, true}) {
    for (const bool big_tiff : {false, true}) {
      std::optional<TiffFile> tiff = Open(RawTiff({image}, big_endian, big_tiff));
      ASSERT_TRUE(tiff);
      EXPECT_EQ(tiff->size(), 1);
      EXPECT_EQ(tiff->Integer(0, TiffTag::kSampleFormat, 1), 2);
      EXPECT_EQ(tiff->Text(0, TiffTag::kGdalNodata), "-9999");
      EXPECT_THAT(tiff->Numbers(0, TiffTag::kModelPixelScale, 9), ElementsAre(30, 30, 0));
      EXPECT_EQ(Metres(Must(ReadDem(dir_ / "dem.tif", {}))), samples_);
    }
  }
}

TEST_F(TiffFiles, TagsThatAreNotThereAreEmpty) {
  std::optional<TiffFile> tiff = Open(RawTiff({{.samples = samples_}}));
  ASSERT_TRUE(tiff);
  EXPECT_EQ(tiff->Text(0, TiffTag::kGdalNodata), "");
  EXPECT_THAT(tiff->Numbers(0, TiffTag::kTileOffsets, 9), IsEmpty());
  EXPECT_EQ(tiff->Integer(0, TiffTag::kTileWidth, 7), 7);
  EXPECT_EQ(tiff->Integer(1, TiffTag::kColumns, 7), 7);
}

TEST_F(TiffFiles, CutShortAnywhereGiveWhatIsThere) {
  const std::string whole = RawTiff({{.samples = samples_}, {.samples = samples_}});
  for (std::size_t bytes = 0; bytes < whole.size(); ++bytes) {
    std::optional<TiffFile> tiff = Open(whole.substr(0, bytes));
    EXPECT_FALSE(tiff && tiff->size() == 2);
    if (!tiff) continue;
    EXPECT_LE(tiff->Numbers(0, TiffTag::kModelPixelScale, 9).size(), 3);
  }
}

TEST_F(TiffFiles, ADirectoryThatLeadsToItselfEnds) {
  std::string bytes = RawTiff({{.samples = samples_}});
  bytes.replace(bytes.size() - 4, 4, bytes.substr(4, 4));
  std::optional<TiffFile> tiff = Open(bytes);
  ASSERT_TRUE(tiff);
  EXPECT_LE(tiff->size(), 1000);
}

TEST_F(TiffFiles, WhichImageOfSeveralWasReadIsSaid) {
  const RawImage coarse = {.columns = 2, .rows = 2, .samples = {1, 2, 3, 4}};
  const RawImage fine = {.samples = samples_};
  const Dem dem = Must(ReadRaw({coarse, fine}));
  EXPECT_EQ(dem.columns, 2);
  ASSERT_THAT(Codes(dem), Contains("tiff-images"));
  std::string said;
  for (const Assumption& a : dem.assumptions) said += a.code == "tiff-images" ? a.text : "";
  EXPECT_THAT(said, HasSubstr("2 x 2"));
  EXPECT_THAT(said, HasSubstr("gdal_translate GTIFF_DIR:2:IN OUT"));
}

TEST_F(TiffFiles, OverviewsAndMasksAreNoFurtherImages) {
  const RawImage fine = {.samples = samples_};
  for (const double subfile : {1.0, 4.0, 5.0}) {
    const RawImage inside = {.columns = 2,
                             .rows = 2,
                             .samples = {1, 2, 3, 4},
                             .more = {{.tag = 254, .type = 4, .numbers = {subfile}}}};
    EXPECT_THAT(Codes(Must(ReadRaw({fine, inside}))), Not(Contains("tiff-images"))) << subfile;
    // But where the reduced image comes first, GDAL reads it.
    EXPECT_THAT(Codes(Must(ReadRaw({inside, fine}))), Contains("tiff-images")) << subfile;
  }
}

TEST_F(TiffFiles, TheScaleOfHeightsInModelPixelScaleIsAppliedAndSaid) {
  const auto scaled = [&](std::vector<double> scale, std::vector<double> tie) {
    return Must(ReadRaw({{.samples = samples_,
                          .more = {{.tag = 33550, .type = 12, .numbers = std::move(scale)},
                                   {.tag = 33922, .type = 12, .numbers = std::move(tie)}}}}));
  };
  const std::vector<double> tie = {0, 0, 0, 500000, 5100000, 0};
  const Dem centimetres = scaled({30, 30, 0.01}, tie);
  EXPECT_DOUBLE_EQ(centimetres.HeightM(5), 0.06);
  EXPECT_THAT(Codes(centimetres), Contains("model-scale"));
  EXPECT_DOUBLE_EQ(scaled({30, 30, 2}, {0, 0, 1, 500000, 5100000, 100}).HeightM(5), 110);
  for (const double nothing : {0.0, 1.0}) {
    const Dem dem = scaled({30, 30, nothing}, tie);
    EXPECT_EQ(dem.HeightM(5), 6);
    EXPECT_THAT(Codes(dem), Not(Contains("model-scale")));
  }
}

TEST_F(TiffFiles, TheBandsOwnScaleWinsOverModelPixelScale) {
  const std::string metadata =
      "<GDALMetadata><Item name=\"SCALE\" sample=\"0\" role=\"scale\">3</Item></GDALMetadata>";
  const Dem dem = Must(ReadRaw({{.samples = samples_,
                                 .more = {{.tag = 33550, .type = 12, .numbers = {30, 30, 0.01}},
                                          {.tag = 42112, .type = 2, .text = metadata}}}}));
  EXPECT_EQ(dem.HeightM(5), 18);
}

}  // namespace
}  // namespace farhorizon

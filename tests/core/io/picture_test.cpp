#include "core/io/picture.h"

#include <cstdlib>
#include <memory>

#include <cpl_vsi.h>
#include <gdal.h>
#include <gdal_frmts.h>
#include <gtest/gtest.h>

namespace farhorizon {
namespace {

// A file's pixels, and the palette's entry for each value that they have.
struct Opened {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> values;
  std::vector<std::array<std::uint8_t, 4>> palette;
};

Opened Open(const char* driver, std::string bytes) {
  GDALRegister_JPEG();
  GDALRegister_PNG();
  const char* const path = "/vsimem/opened";
  VSIFCloseL(VSIFileFromMemBuffer(path, reinterpret_cast<GByte*>(bytes.data()), bytes.size(), 0));
  const char* const drivers[] = {driver, nullptr};
  const GDALDatasetH dataset = GDALOpenEx(path, GDAL_OF_RASTER, drivers, nullptr, nullptr);
  Opened opened;
  if (dataset != nullptr) {
    opened.width = GDALGetRasterXSize(dataset);
    opened.height = GDALGetRasterYSize(dataset);
    opened.values.resize(static_cast<std::size_t>(opened.width) *
                         static_cast<std::size_t>(opened.height));
    const GDALRasterBandH band = GDALGetRasterBand(dataset, 1);
    EXPECT_EQ(GDALRasterIO(band, GF_Read, 0, 0, opened.width, opened.height, opened.values.data(),
                           opened.width, opened.height, GDT_Byte, 0, 0),
              CE_None);
    if (const GDALColorTableH table = GDALGetRasterColorTable(band); table != nullptr) {
      for (int i = 0; i < GDALGetColorEntryCount(table); ++i) {
        const GDALColorEntry* entry = GDALGetColorEntry(table, i);
        const auto byte = [](GInt16 value) { return static_cast<std::uint8_t>(value); };
        opened.palette.push_back(
            {byte(entry->c1), byte(entry->c2), byte(entry->c3), byte(entry->c4)});
      }
    }
    GDALClose(dataset);
  }
  VSIUnlink(path);
  return opened;
}

TEST(EncodePng, KeepsEveryPixelAndItsOpacity) {
  PalettePicture picture{3, 2, {0, 1, 2, 2, 1, 0}, {{0, 0, 0, 0}, {255, 0, 1, 255}, {9, 8, 7, 99}}};
  const std::string bytes = *EncodePng(picture);
  const Opened opened = Open("PNG", bytes);
  EXPECT_EQ(opened.width, 3);
  EXPECT_EQ(opened.height, 2);
  EXPECT_EQ(opened.values, picture.values);
  ASSERT_GE(opened.palette.size(), picture.palette.size());
  for (std::size_t i = 0; i < picture.palette.size(); ++i) {
    EXPECT_EQ(opened.palette[i], picture.palette[i]) << i;
  }
  EXPECT_EQ(*EncodePng(picture), bytes);
}

TEST(EncodeJpeg, IsNearAndTheSameEachTime) {
  GreyPicture picture{64, 5, {}};
  for (int i = 0; i < 64 * 5; ++i) {
    picture.values.push_back(static_cast<std::uint8_t>(60 + 2 * (i % 64)));
  }
  const std::string bytes = *EncodeJpeg(picture, 90);
  const Opened opened = Open("JPEG", bytes);
  ASSERT_EQ(opened.width, 64);
  ASSERT_EQ(opened.height, 5);
  for (std::size_t i = 0; i < picture.values.size(); ++i) {
    EXPECT_LE(std::abs(opened.values[i] - picture.values[i]), 8) << i;
  }
  EXPECT_EQ(*EncodeJpeg(picture, 90), bytes);
  EXPECT_LT(EncodeJpeg(picture, 20)->size(), bytes.size());
}

TEST(EncodeJpeg, TakesOnePixel) { EXPECT_TRUE(EncodeJpeg({1, 1, {7}}, 80)); }

}  // namespace
}  // namespace farhorizon

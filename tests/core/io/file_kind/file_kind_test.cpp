#include "core/io/file_kind/file_kind.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/file_kind/hgt_name.h"

namespace farhorizon {
namespace {

using ::testing::HasSubstr;
using namespace std::string_literals;

FileKind KindOf(const std::string& bytes, const std::string& name = "a") {
  return KindOfFile({bytes, static_cast<std::int64_t>(bytes.size()), name});
}

std::string Said(const std::string& bytes, const std::string& name = "a") {
  return UnreadFile({bytes, static_cast<std::int64_t>(bytes.size()), name}, "it", "").message;
}

TEST(FileKind, KnowsWhatIsRead) {
  EXPECT_EQ(KindOf("MM\0*"s), FileKind::kTiff);
  EXPECT_EQ(KindOf("II+\0\b\0"s), FileKind::kTiff);
  EXPECT_EQ(KindOf("UHL1"), FileKind::kDted);
  EXPECT_EQ(KindOf("VOL1" + std::string(76, ' ') + "UHL1"), FileKind::kDted);
  EXPECT_EQ(KindOf("ncols 3\nnrows 3\n"), FileKind::kArcGrid);
  EXPECT_EQ(KindOf("\xef\xbb\xbf\r\n NROWS\t3\n"), FileKind::kArcGrid);
  EXPECT_EQ(KindOf(""), FileKind::kOther);
  EXPECT_EQ(KindOf("VOL1"), FileKind::kOther);
}

TEST(FileKind, KnowsHgtByNameAndSize) {
  EXPECT_EQ(KindOfFile({"", 2 * 1201 * 1201, "N46E007.hgt"}), FileKind::kHgt);
  EXPECT_EQ(KindOfFile({"", 2 * 3601 * 1801, "s70w007.SRTMGL1.HGT"}), FileKind::kHgt);
  EXPECT_EQ(KindOfFile({"", 100, "N46E007.hgt"}), FileKind::kOther);
  EXPECT_EQ(KindOfFile({"", 2 * 1201 * 1201, "dem.hgt"}), FileKind::kOther);
}

TEST(FileKind, SaysThatHgtIsKnownByItsName) {
  for (const char* name : {"N38E050 (1).hgt", "n38e050_1arc.hgt", "dem.hgt", "N38E50.hgt"}) {
    const Error said = UnreadFile({"", 2 * 1201 * 1201, name}, "it", "");
    EXPECT_THAT(said.message, HasSubstr("known by its name")) << name;
    EXPECT_EQ(said.kind, "not-a-raster");
  }
  EXPECT_THAT(UnreadFile({"", 2 * 1201 * 1201, "N38E050 (1).hgt"}, "it", "").message,
              HasSubstr("such as N38E050.hgt"));
}

TEST(FileKind, SaysHowMuchOfAnHgtIsThere) {
  const Error said = UnreadFile({"\1", 2 * 1201 * 1000, "N38E007.hgt"}, "it", "");
  EXPECT_EQ(said.kind, "truncated");
  EXPECT_THAT(said.message, HasSubstr("2402000 of 2884802 bytes"));
}

TEST(FileKind, NamesWhatIsNotRead) {
  EXPECT_THAT(Said("CDF\x01"), HasSubstr("netCDF file; take its heights out "
                                         "with gdal_translate NETCDF:IN:VARIABLE OUT.tif"));
  EXPECT_THAT(Said("\x89HDF\r\n\x1a\n"), HasSubstr("HDF5"));
  EXPECT_THAT(Said("<VRTDataset rasterXSize=\"3\">"), HasSubstr("VRT"));
  EXPECT_THAT(Said("<?xml version=\"1.0\"?>\n<VRTDataset>"), HasSubstr("VRT"));
  EXPECT_THAT(Said("\n<!DOCTYPE html><html>"), HasSubstr("web page"));
  EXPECT_THAT(Said("PK\x03\x04"), HasSubstr("unzip IN"));
  EXPECT_THAT(Said("\x1f\x8b\x08"), HasSubstr("gunzip IN"));
  EXPECT_THAT(Said(std::string(257, 'a') + "ustar"), HasSubstr("tar archive"));
  EXPECT_THAT(Said("\x89PNG\r\n"), HasSubstr("PNG picture"));
  EXPECT_THAT(Said("RIFF1234WEBP"), HasSubstr("WebP"));
  EXPECT_THAT(Said("LASF"), HasSubstr("point cloud"));
  EXPECT_THAT(Said("SQLite format 3"), HasSubstr("GeoPackage"));
  EXPECT_THAT(Said("{\"type\": 1}"), HasSubstr("JSON"));
  EXPECT_THAT(Said("%PDF-1.4"), HasSubstr("PDF"));
  EXPECT_THAT(Said("version https://git-lfs.github.com/spec/v1\n"), HasSubstr("git lfs pull"));
  EXPECT_THAT(Said("\xff\xfen\0c\0"s), HasSubstr("iconv -f UTF-16"));
  EXPECT_THAT(Said(std::string(64, '\0')), HasSubstr("zeros"));
  EXPECT_THAT(Said(""), HasSubstr("empty"));
  EXPECT_THAT(Said("II*\0"s), HasSubstr("TIFF that cannot be opened"));
  EXPECT_THAT(Said("12 34", "dem.bil"), HasSubstr(".hdr"));
  EXPECT_THAT(Said("ENVI\nsamples = 3", "dem.hdr"), HasSubstr("header of an ENVI raster"));
  EXPECT_THAT(Said("n\0c\0o\0l\0s\0 \0"
                   "4\0\n\0"s),
              HasSubstr("iconv -f UTF-16LE"));
  EXPECT_THAT(Said("\0n\0c\0o\0l\0s\0 \0"
                   "4\0\n"s),
              HasSubstr("iconv -f UTF-16BE"));
  EXPECT_THAT(Said("\xff\xfe\0\0n\0\0\0"s), HasSubstr("UTF-32"));
  EXPECT_THAT(Said("1 2 3 4\n1 2 3 4\n"), HasSubstr("table of numbers"));
  EXPECT_THAT(Said("id,x,y,z\n1,2,3,4\n"), HasSubstr("table of numbers"));
  EXPECT_THAT(Said("# made by hand\nncols 3\n"), HasSubstr("sed '/^#/d'"));
  EXPECT_THAT(Said("404: Not Found", "dem.tif"), HasSubstr("text that is no grid"));
  EXPECT_THAT(Said("\1\2\3\4\5", "dem.tif"), HasSubstr("no raster that can be read"));
}

}  // namespace
}  // namespace farhorizon

#include "service/handlers/raster_sniff.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace farhorizon {
namespace {

using ::testing::HasSubstr;

// "taken", or why not.
std::string Said(const std::string& beginning, std::int64_t bytes, const std::string& name) {
  Status taken = CheckUpload(beginning, bytes, name);
  return taken ? "taken" : taken.error().message;
}

TEST(RasterSniff, TakesTheFormatsThatAreOneFile) {
  EXPECT_EQ(Said(std::string("MM\0*", 4), 100, "a"), "taken");
  EXPECT_EQ(Said("ncols 3\nnrows 3\n", 100, "a"), "taken");
  EXPECT_EQ(Said("\xef\xbb\xbfncols 3\n", 100, "a"), "taken");
  EXPECT_EQ(Said("UHL1", 100, "a"), "taken");
  EXPECT_EQ(Said("VOL1" + std::string(76, ' ') + "HDR1" + std::string(76, ' ') + "UHL1", 1000, "a"),
            "taken");
  EXPECT_EQ(Said("", 2 * 1201 * 1201, "N46E007.hgt"), "taken");
  EXPECT_EQ(Said("PK\x03\x04", 3544, "N10W110.hgt.zip"), "taken");
  EXPECT_EQ(Said("EHFA_HEADER_TAG", 1000, "a"), "taken");
  EXPECT_EQ(Said("DSAA\n3 2\n", 100, "a"), "taken");
  EXPECT_EQ(Said("DSBB", 100, "a"), "taken");
  EXPECT_EQ(Said("DSRB", 100, "a"), "taken");
  EXPECT_EQ(Said("north: 3\nsouth: 1\n", 100, "a"), "taken");
  EXPECT_EQ(Said("1 2 3\n2 2 3\n", 100, "a"), "taken");
}

TEST(RasterSniff, SaysWhyOthersAreNot) {
  EXPECT_THAT(Said("\1\2", 2 * 1201 * 1201, "dem"), HasSubstr("known by its name"));
  EXPECT_THAT(Said("\1", 100, "N46E007.hgt"), HasSubstr("bytes"));
  EXPECT_THAT(Said("<VRTDataset>", 100, "a.tif"), HasSubstr("the DEM is a VRT"));
  EXPECT_THAT(Said("PK\x03\x04", 3544, "tiles.zip"), HasSubstr("zip archive"));
  EXPECT_THAT(Said("", 0, "a.tif"), HasSubstr("no bytes"));
  EXPECT_THAT(Said("\1\2\3\4", 4, "a"), HasSubstr("expected GeoTIFF"));
}

}  // namespace
}  // namespace farhorizon

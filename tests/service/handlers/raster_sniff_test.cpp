#include "service/handlers/raster_sniff.h"

#include <string>

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

TEST(RasterSniff, KnowsTheFormatsThatAreRead) {
  EXPECT_TRUE(LooksLikeRaster(std::string("MM\0*", 4), 100, "a"));
  EXPECT_TRUE(LooksLikeRaster("ncols 3\nnrows 3\n", 100, "a"));
  EXPECT_TRUE(LooksLikeRaster("UHL1", 100, "a"));
  EXPECT_TRUE(LooksLikeRaster(
      "VOL1" + std::string(76, ' ') + "HDR1" + std::string(76, ' ') + "UHL1", 1000, "a"));
  EXPECT_TRUE(LooksLikeRaster("", 2 * 1201 * 1201, "N46E007.hgt"));
  EXPECT_FALSE(LooksLikeRaster("", 2 * 1201 * 1201, "dem"));
  EXPECT_FALSE(LooksLikeRaster("", 100, "N46E007.hgt"));
  EXPECT_FALSE(LooksLikeRaster("<VRTDataset>", 100, "a.tif"));
  EXPECT_FALSE(LooksLikeRaster("VOL1", 4, "a"));
}

}  // namespace
}  // namespace farhorizon

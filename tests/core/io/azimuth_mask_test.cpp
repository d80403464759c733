#include "core/io/azimuth_mask.h"

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

TEST(AzimuthMask, AnIntervalHasEveryBinThatItTouches) {
  EXPECT_EQ(MaskOfInterval(0, 1), 1U);
  EXPECT_EQ(MaskOfInterval(2.8, 2.9), 3U);  // a bin is 2.8125 degrees wide
  EXPECT_EQ(MaskOfInterval(3, 5), 2U);
  EXPECT_EQ(MaskOfInterval(179, 181), 1U | AzimuthMask{1} << 63U);
}

TEST(AzimuthMask, ALineOfSightHasNoSense) {
  EXPECT_EQ(MaskOfInterval(90, 100), MaskOfInterval(270, 280));
  EXPECT_EQ(MaskOfInterval(-90, -80), MaskOfInterval(90, 100));
}

TEST(AzimuthMask, HalfATurnIsAllBins) {
  EXPECT_EQ(MaskOfInterval(17, 197), ~AzimuthMask{0});
  EXPECT_EQ(MaskOfInterval(0, 1000), ~AzimuthMask{0});
}

TEST(AzimuthMask, IntervalsAreJoined) {
  EXPECT_EQ(MaskOf({{0, 1}, {90, 91}}), 1U | AzimuthMask{1} << 32U);
  EXPECT_EQ(MaskOf({}), 0U);
}

TEST(AzimuthMask, TextHasTheHighestBinFirst) {
  EXPECT_EQ(MaskText(1), "0000000000000001");
  EXPECT_EQ(MaskText(AzimuthMask{0xab} << 56U), "ab00000000000000");
}

}  // namespace
}  // namespace farhorizon

#include "core/geo/frame_choice.h"

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

TEST(FrameChoice, IsReadAsItIsWritten) {
  for (const FrameChoice& frame :
       {FrameChoice{}, FrameChoice{.axes = FrameAxes::kGlobe},
        FrameChoice{FrameAxes::kPlace, -122.1, 37.0 / 3}, FrameChoice{FrameAxes::kPlace, 180, -90},
        FrameChoice{FrameAxes::kPlace, 1e-7, 0}}) {
    const std::optional<FrameChoice> read = FrameFromText(FrameText(frame));
    ASSERT_TRUE(read) << FrameText(frame);
    EXPECT_EQ(*read, frame);
  }
  EXPECT_EQ(FrameText({FrameAxes::kPlace, 7.5, 46}), "7.5,46");
  EXPECT_EQ(FrameFromText(" +7.5 , 46 "), (FrameChoice{FrameAxes::kPlace, 7.5, 46}));
}

TEST(FrameChoice, OtherTextsAreNone) {
  for (const char* text : {"", "tiles", "7", "7,", ",46", "7,46,0", "181,0", "0,90.001", "nan,0",
                           "7;46", "0x7,46", "7,46 N"}) {
    EXPECT_FALSE(FrameFromText(text)) << text;
  }
}

}  // namespace
}  // namespace farhorizon

#include "core/io/ticks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace farhorizon {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(TickStep, IsRound) {
  EXPECT_EQ(TickStep(8, 8), 1);
  EXPECT_EQ(TickStep(9, 8), 2);
  EXPECT_EQ(TickStep(17, 8), 5);
  EXPECT_EQ(TickStep(41, 8), 10);
  EXPECT_DOUBLE_EQ(TickStep(0.01, 8), 0.002);
}

TEST(TicksWithin, AreTheMultiples) {
  EXPECT_THAT(TicksWithin(-3, 5, 2), ElementsAre(-2, 0, 2, 4));
  EXPECT_THAT(TicksWithin(2, 4, 2), ElementsAre(2, 4));
  EXPECT_THAT(TicksWithin(2.5, 3.5, 2), IsEmpty());
  EXPECT_THAT(TicksWithin(4, 2, 1), IsEmpty());
}

}  // namespace
}  // namespace farhorizon

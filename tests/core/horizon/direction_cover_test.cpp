#include "core/horizon/direction_cover.h"

#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

constexpr double kOff = 0.9e-8;  // what keys may be off by

void Add(DirectionCover& cover, const Vector& from, const Vector& to) {
  const Direction first = MakeDirection(from);
  const Direction last = MakeDirection(to);
  cover.Add(first, last, first.turned != last.turned, nullptr);
}

// A range from the start on, by keys that are off, may begin before the end of the half turn.
TEST(DirectionCover, IsNotSureOfARangeAtTheStartUnlessTheEndIsCoveredToo) {
  DirectionCover cover;
  Add(cover, {1, 0}, {1, 1});
  EXPECT_FALSE(cover.SurelyCovers(0, 0.2));
  EXPECT_TRUE(cover.SurelyCovers(0.1, 0.2));
  EXPECT_FALSE(cover.SurelyCovers(0.1, 0.5));
  Add(cover, {-1, 1}, {-1, 0});
  EXPECT_TRUE(cover.SurelyCovers(0, 0.2));
  EXPECT_TRUE(cover.SurelyCovers(1.9, 0.2));
  EXPECT_TRUE(cover.SurelyCovers(1.9, 2));
  EXPECT_FALSE(cover.SurelyCovers(1.9, 1.1));
}

// Whatever it is sure of by keys that are off, it has: adding it changes nothing.
TEST(DirectionCover, CoversWhatItIsSureOf) {
  std::mt19937 random(1);
  const auto any = [&random] {
    const int x = static_cast<int>(random() % 41) - 20;
    const int y = static_cast<int>(random() % 41) - 20;
    return x == 0 && y == 0 ? Vector{1, 0} : Vector{x, y};
  };
  const auto off = [&random](double key) {
    const double moved = key + kOff * (static_cast<double>(random() % 201) / 100 - 1);
    return moved < 0 ? moved + 2 : (moved > 2 ? moved - 2 : moved);
  };
  int sure = 0;
  for (int round = 0; round < 20000; ++round) {
    DirectionCover cover;
    for (std::uint32_t arcs = 1 + random() % 4; arcs > 0; --arcs) {
      const Vector from = any();
      const Vector to = any();
      if (CrossSign(from, to) > 0) Add(cover, from, to);
    }
    const Vector from = any();
    const Vector to = any();
    if (CrossSign(from, to) <= 0 || cover.IsComplete()) continue;
    if (!cover.SurelyCovers(off(MakeDirection(from).key), off(MakeDirection(to).key))) continue;
    ++sure;
    const auto before = cover.WidestGap();
    Add(cover, from, to);
    const auto after = cover.WidestGap();
    ASSERT_TRUE(before && after);
    ASSERT_EQ(CrossSign(before->from, after->from), 0);
    ASSERT_EQ(CrossSign(before->to, after->to), 0);
  }
  EXPECT_GT(sure, 500);
}

}  // namespace
}  // namespace farhorizon

#include "core/horizon/visibility/direction_set.h"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

void Add(DirectionSet& cover, const Vector& from, const Vector& to) {
  const Direction first = MakeDirection(from);
  const Direction last = MakeDirection(to);
  cover.Add(first, last, first.turned != last.turned, nullptr);
}

TEST(DirectionSet, HidesWhatIsInItsDirectionsWhole) {
  DirectionSet cover;
  EXPECT_FALSE(cover.SurelyContains(PlanStroke{5, 1, 5, 2}));
  Add(cover, {1, 0}, {1, 1});
  EXPECT_TRUE(cover.SurelyContains(PlanStroke{5, 1, 5, 2}));
  EXPECT_TRUE(cover.SurelyContains(PlanStroke{-5, -1, -5, -2}));
  EXPECT_FALSE(cover.SurelyContains(PlanStroke{5, 0, 5, 2}));  // by less than rounding can do
  EXPECT_FALSE(cover.SurelyContains(PlanStroke{5, -1, 5, 2}));
  EXPECT_FALSE(cover.SurelyContains(PlanStroke{5, 1, -5, -2}));  // around the eye
  EXPECT_TRUE(cover.SurelyContains(PlanBox{10, 4, 2, 2}));
  EXPECT_FALSE(cover.SurelyContains(PlanBox{10, 4, 2, 5}));
  EXPECT_FALSE(cover.SurelyContains(PlanBox{0, 0, 1, 1}));
  Add(cover, {-1, 1}, {-1, 0});
  EXPECT_TRUE(cover.SurelyContains(PlanStroke{5, 0, 5, 2}));
  EXPECT_TRUE(cover.SurelyContains(PlanStroke{5, -1, 5, 2}));
}

// Whatever it is sure of by coordinates that are off, it has: adding it changes nothing.
TEST(DirectionSet, CoversWhatItIsSureOf) {
  std::mt19937 random(1);
  const auto any = [&random] {
    const int x = static_cast<int>(random() % 41) - 20;
    const int y = static_cast<int>(random() % 41) - 20;
    return x == 0 && y == 0 ? Vector{1, 0} : Vector{x, y};
  };
  const auto off = [&random](Int128 coordinate) {
    return static_cast<double>(coordinate) + 1e-8 * (static_cast<double>(random() % 201) / 100 - 1);
  };
  int sure = 0;
  int sure_of_boxes = 0;
  for (int round = 0; round < 40000; ++round) {
    DirectionSet cover;
    for (std::uint32_t arcs = 1 + random() % 4; arcs > 0; --arcs) {
      const Vector from = any();
      const Vector to = any();
      if (CrossSign(from, to) > 0) Add(cover, from, to);
    }
    const Vector from = any();
    const Vector to = any();
    if (CrossSign(from, to) <= 0 || cover.IsComplete()) continue;
    const PlanStroke stroke{off(from.x), off(from.y), off(to.x), off(to.y)};
    const PlanBox box{off(from.x + to.x) / 2, off(from.y + to.y) / 2,
                      std::abs(off(to.x - from.x)) / 2, std::abs(off(to.y - from.y)) / 2};
    const bool hides = cover.SurelyContains(stroke);
    const bool hides_box = cover.SurelyContains(box);
    ASSERT_TRUE(hides || !hides_box) << "the box contains the stroke";
    if (!hides) continue;
    ++sure;
    sure_of_boxes += static_cast<int>(hides_box);
    const auto before = cover.WidestGap();
    Add(cover, from, to);
    const auto after = cover.WidestGap();
    ASSERT_TRUE(before && after);
    ASSERT_EQ(CrossSign(before->from, after->from), 0);
    ASSERT_EQ(CrossSign(before->to, after->to), 0);
  }
  EXPECT_GT(sure, 500);
  EXPECT_GT(sure_of_boxes, 100);
}

}  // namespace
}  // namespace farhorizon

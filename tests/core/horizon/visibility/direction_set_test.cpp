#include "core/horizon/visibility/direction_set.h"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

void Add(DirectionSet& set, const Vector& from, const Vector& to) {
  const Direction first = MakeDirection(from);
  const Direction last = MakeDirection(to);
  set.Add(first, last, first.turned != last.turned, nullptr);
}

TEST(DirectionSet, SurelyContainsWhatLiesInItsDirectionsAsAWhole) {
  DirectionSet set;
  EXPECT_FALSE(set.SurelyContains(PlanSegment{5, 1, 5, 2}));
  Add(set, {1, 0}, {1, 1});
  EXPECT_TRUE(set.SurelyContains(PlanSegment{5, 1, 5, 2}));
  EXPECT_TRUE(set.SurelyContains(PlanSegment{-5, -1, -5, -2}));
  EXPECT_FALSE(set.SurelyContains(PlanSegment{5, 0, 5, 2}));  // within the margin
  EXPECT_FALSE(set.SurelyContains(PlanSegment{5, -1, 5, 2}));
  EXPECT_FALSE(set.SurelyContains(PlanSegment{5, 1, -5, -2}));  // on both sides of the viewpoint
  EXPECT_TRUE(set.SurelyContains(PlanBox{10, 4, 2, 2}));
  EXPECT_FALSE(set.SurelyContains(PlanBox{10, 4, 2, 5}));
  EXPECT_FALSE(set.SurelyContains(PlanBox{0, 0, 1, 1}));
  Add(set, {-1, 1}, {-1, 0});
  EXPECT_TRUE(set.SurelyContains(PlanSegment{5, 0, 5, 2}));
  EXPECT_TRUE(set.SurelyContains(PlanSegment{5, -1, 5, 2}));
}

// Adding what SurelyContains is true for, by coordinates that are off, changes nothing.
TEST(DirectionSet, ContainsWhatItSurelyContains) {
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
    DirectionSet set;
    for (std::uint32_t arcs = 1 + random() % 4; arcs > 0; --arcs) {
      const Vector from = any();
      const Vector to = any();
      if (CrossSign(from, to) > 0) Add(set, from, to);
    }
    const Vector from = any();
    const Vector to = any();
    if (CrossSign(from, to) <= 0 || set.IsComplete()) continue;
    const PlanSegment segment{off(from.x), off(from.y), off(to.x), off(to.y)};
    const PlanBox box{off(from.x + to.x) / 2, off(from.y + to.y) / 2,
                      std::abs(off(to.x - from.x)) / 2, std::abs(off(to.y - from.y)) / 2};
    const bool contains = set.SurelyContains(segment);
    const bool contains_box = set.SurelyContains(box);
    ASSERT_TRUE(contains || !contains_box) << "the box contains the segment";
    if (!contains) continue;
    ++sure;
    sure_of_boxes += static_cast<int>(contains_box);
    const auto before = set.WidestFreeArc();
    Add(set, from, to);
    const auto after = set.WidestFreeArc();
    ASSERT_TRUE(before && after);
    ASSERT_EQ(CrossSign(before->from, after->from), 0);
    ASSERT_EQ(CrossSign(before->to, after->to), 0);
  }
  EXPECT_GT(sure, 500);
  EXPECT_GT(sure_of_boxes, 100);
}

}  // namespace
}  // namespace farhorizon

#include "core/geometry/interval_set.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

bool Holds(const std::vector<Interval>& intervals, double x) {
  return std::any_of(intervals.begin(), intervals.end(),
                     [x](const Interval& i) { return i[0] <= x && x <= i[1]; });
}

TEST(UnionOf, IsDisjointRisingAndHoldsWhatTheIntervalsHold) {
  std::mt19937 random(1);
  for (int round = 0; round < 2000; ++round) {
    std::vector<Interval> intervals(random() % 8);
    for (Interval& i : intervals) {
      const auto [from, to] = std::minmax({random() % 20, random() % 20});
      i = {static_cast<double>(from), static_cast<double>(to)};
    }
    const std::vector<Interval> disjoint = UnionOf(intervals);
    for (std::size_t k = 0; k + 1 < disjoint.size(); ++k) {
      ASSERT_LT(disjoint[k][1], disjoint[k + 1][0]);
    }
    for (double x = -1; x <= 20; x += 0.5) ASSERT_EQ(Holds(disjoint, x), Holds(intervals, x));
  }
}

TEST(UnionOf, JoinsIntervalsThatTouch) {
  EXPECT_EQ(UnionOf({{2, 3}, {0, 1}, {1, 2}}), (std::vector<Interval>{{0, 3}}));
  EXPECT_EQ(UnionOf({{2, 3}, {0, 1}}), (std::vector<Interval>{{0, 1}, {2, 3}}));
}

}  // namespace
}  // namespace farhorizon

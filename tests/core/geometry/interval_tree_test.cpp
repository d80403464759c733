#include "core/geometry/interval_tree.h"

#include <algorithm>
#include <random>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace farhorizon {
namespace {

using Entry = IntervalTree::Entry;

TEST(IntervalTree, FindsTheIntervalsThatASearchThroughAllFinds) {
  std::mt19937 random(1);
  for (int round = 0; round < 300; ++round) {
    std::vector<Entry> intervals;
    const auto count = static_cast<std::int32_t>(random() % 60);
    const auto ends = static_cast<double>(1 + random() % 40);  // few: many are shared
    for (std::int32_t id = 0; id < count; ++id) {
      const double a = static_cast<double>(random() % 1000) / 1000 * ends;
      const double b = random() % 4 == 0 ? a : static_cast<double>(random() % 40);
      intervals.push_back({std::min(a, b), std::max(a, b), id});
    }
    const IntervalTree tree(intervals);
    std::vector<double> queries = {-1, 50, 0, 7.5};
    for (const Entry& interval : intervals) {
      queries.insert(queries.end(),
                     {interval.from, interval.to, (interval.from + interval.to) / 2});
    }
    for (const double x : queries) {
      std::vector<std::int32_t> holding;
      for (const Entry& interval : intervals) {
        if (interval.from <= x && x <= interval.to) holding.push_back(interval.id);
      }
      ASSERT_THAT(tree.Holding(x), testing::UnorderedElementsAreArray(holding)) << x;
    }
  }
}

TEST(IntervalTree, TakesOneIntervalAThousandTimes) {
  const IntervalTree tree(std::vector<Entry>(1000, Entry{1, 2, 7}));
  EXPECT_EQ(tree.Holding(2).size(), 1000U);
  EXPECT_EQ(tree.Holding(2.5).size(), 0U);
}

}  // namespace
}  // namespace farhorizon

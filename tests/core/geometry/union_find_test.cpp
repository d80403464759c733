#include "core/geometry/union_find.h"

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

// The slow twin: the number of its set beside each node.
TEST(FindRoot, IsTheSameExactlyForNodesThatWereJoined) {
  constexpr std::int32_t kNodes = 60;
  std::mt19937 random(1);
  const auto any = [&random] { return static_cast<std::int32_t>(random() % kNodes); };
  for (int round = 0; round < 100; ++round) {
    std::vector<std::int32_t> parents(kNodes);
    std::iota(parents.begin(), parents.end(), 0);
    std::vector<std::int32_t> sets = parents;
    for (int join = 0; join < 50; ++join) {
      const std::int32_t a = any();
      const std::int32_t b = any();
      parents[static_cast<std::size_t>(FindRoot(parents, a))] = FindRoot(parents, b);
      const std::int32_t old_set = sets[static_cast<std::size_t>(a)];
      const std::int32_t new_set = sets[static_cast<std::size_t>(b)];
      std::replace(sets.begin(), sets.end(), old_set, new_set);
      const std::int32_t p = any();
      const std::int32_t q = any();
      ASSERT_EQ(FindRoot(parents, p) == FindRoot(parents, q),
                sets[static_cast<std::size_t>(p)] == sets[static_cast<std::size_t>(q)]);
    }
  }
}

TEST(FindRoot, HalvesThePathOnItsWay) {
  std::vector<std::int32_t> parents = {0, 0, 1, 2, 3};
  EXPECT_EQ(FindRoot(parents, 4), 0);
  EXPECT_EQ(parents, (std::vector<std::int32_t>{0, 0, 0, 2, 2}));
}

}  // namespace
}  // namespace farhorizon

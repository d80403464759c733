#include "core/simplify/lines/line_lists.h"

#include <algorithm>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/effort.h"

namespace farhorizon {
namespace {

TEST(LineLists, AreListsThatGrowAtTheFront) {
  std::mt19937 random(1);
  for (int round = 0; round < Rounds(200); ++round) {
    LineLists lists(5);
    std::vector<std::vector<std::int32_t>> wanted(5);
    for (int step = 0; step < 200; ++step) {
      const auto v = static_cast<std::int32_t>(random() % 5);
      std::vector<std::int32_t>& list = wanted[static_cast<std::size_t>(v)];
      const auto line = static_cast<std::int32_t>(random() % 20);
      if (random() % 10 == 0) {
        std::vector<std::int32_t> taken = {-1};
        lists.Take(v, taken);
        ASSERT_EQ(taken, list);
        list.clear();
      } else if (random() % 3 == 0) {
        const auto drop = [line](std::int32_t other) { return other % 7 == line % 7; };
        lists.EraseIf(v, drop);
        std::erase_if(list, drop);
      } else {
        lists.Add(v, line);
        list.insert(list.begin(), line);
      }
      for (std::int32_t w = 0; w < 5; ++w) {
        std::vector<std::int32_t> found;
        lists.ForEach(w, [&](std::int32_t l) { found.push_back(l); });
        ASSERT_EQ(found, wanted[static_cast<std::size_t>(w)]);
      }
    }
  }
}

}  // namespace
}  // namespace farhorizon

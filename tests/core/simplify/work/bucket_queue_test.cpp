#include "core/simplify/work/bucket_queue.h"

#include <algorithm>
#include <limits>
#include <map>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/effort.h"

namespace farhorizon {
namespace {

TEST(BucketQueue, PutsWhatCostsNextToNothingFirst) {
  const float infinity = std::numeric_limits<float>::infinity();
  for (const float cost : {0.0F, -0.0F, -1.0F, -infinity, 1e-13F, 1e-12F}) {
    EXPECT_EQ(BucketQueue::BucketOf(cost), 0) << cost;
  }
  EXPECT_EQ(BucketQueue::BucketOf(std::numeric_limits<float>::quiet_NaN()), 0);
  EXPECT_GT(BucketQueue::BucketOf(1.1e-12F), 0);
}

TEST(BucketQueue, ABucketHasCostsOfLessThanAnOctaveAndBucketsRiseWithTheCost) {
  std::map<std::int32_t, std::pair<float, float>> range;
  std::int32_t last = 0;
  for (float cost = 1.01e-12F; cost < 1e35F; cost *= 1.01F) {
    const std::int32_t bucket = BucketQueue::BucketOf(cost);
    ASSERT_GE(bucket, last);
    ASSERT_LE(bucket, last + 1);
    last = bucket;
    range.emplace(bucket, std::pair{cost, cost}).first->second.second = cost;
  }
  EXPECT_GT(range.size(), 300U);
  for (const auto& [bucket, costs] : range) ASSERT_LT(costs.second, 1.5F * costs.first);
}

TEST(BucketQueue, GivesWhatASortedMapOfListsGives) {
  std::mt19937 random(1);
  for (int round = 0; round < Rounds(300); ++round) {
    BucketQueue queue;
    std::map<std::int32_t, std::vector<std::int32_t>> wanted;
    std::vector<std::int32_t> taken = {-5};
    EXPECT_EQ(queue.Lowest(), -1);
    for (int step = 0; step < 100; ++step) {
      if (random() % 3 > 0) {
        const auto vertex = static_cast<std::int32_t>(random() % 1000);
        const auto bucket = static_cast<std::int32_t>(random() % 40);
        queue.Add(vertex, bucket);
        wanted[bucket].push_back(vertex);
      } else {
        ASSERT_EQ(queue.Lowest(), wanted.empty() ? -1 : wanted.begin()->first);
        if (wanted.empty()) continue;
        std::vector<std::int32_t>& first = wanted.begin()->second;
        std::sort(first.begin(), first.end());
        queue.Take(wanted.begin()->first, taken);
        ASSERT_EQ(taken, first);
        wanted.erase(wanted.begin());
      }
    }
    queue.Clear();
    EXPECT_EQ(queue.Lowest(), -1);
  }
}

}  // namespace
}  // namespace farhorizon

#include "core/pipeline/build_cost.h"

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

constexpr double kMebibyte = 1 << 20;

// Peaks that were measured, of the head of build_cost.cpp. Real ground needs at most what is
// expected, noise at most three times as much, and no estimate is more than twice the peak.
TEST(BuildCost, EnclosesTheMeasuredPeaks) {
  struct Peak {
    std::int64_t side;
    double mebibytes;
    double most;  // by what the estimate may fall short
  };
  for (const Peak& peak :
       {Peak{65, 68, 1}, Peak{257, 87, 1}, Peak{513, 127, 1}, Peak{1000, 251, 1},
        Peak{1201, 281, 1}, Peak{2000, 680, 1}, Peak{3600, 2450, 1}, Peak{257, 105, 3},
        Peak{513, 227, 3}, Peak{1000, 722, 3}, Peak{1400, 1174, 3}}) {
    const double expected =
        static_cast<double>(EstimateBuild(peak.side * peak.side, {}).memory_bytes) / kMebibyte;
    EXPECT_GE(expected * peak.most, peak.mebibytes) << peak.side;
    EXPECT_LE(expected, 2 * peak.mebibytes) << peak.side;
  }
}

TEST(BuildCost, AThreadAndApproximationCostMore) {
  BuildOptions options;
  const BuildCost one = EstimateBuild(1000, options);
  options.threads = 4;
  EXPECT_GT(EstimateBuild(1000, options).memory_bytes, one.memory_bytes);
  options.approximate = true;
  EXPECT_GT(EstimateBuild(1000, options).cpu_seconds, one.cpu_seconds);
}

TEST(BuildCost, PostsWithinIsTheInverse) {
  const BuildOptions options;
  for (const unsigned bits : {27U, 28U, 29U, 32U, 36U}) {
    const std::int64_t memory = std::int64_t{1} << bits;
    const std::int64_t most = PostsWithin(memory, options);
    EXPECT_LE(EstimateBuild(most, options).memory_bytes, memory) << bits;
    EXPECT_GT(EstimateBuild(most + 1, options).memory_bytes, memory) << bits;
  }
  EXPECT_GE(PostsWithin(std::int64_t{1} << 32U, options), 4400 * 4400)
      << "more than a tile of a degree and an arc second fits in the default";
  EXPECT_EQ(PostsWithin(1, options), 0);
}

}  // namespace
}  // namespace farhorizon

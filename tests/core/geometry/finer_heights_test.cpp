#include "core/geometry/finer_heights.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

constexpr std::int64_t kLimit = std::int64_t{1} << 30;
constexpr std::int32_t kMost = (1 << 30) - 1;

constexpr HeightRange kRanges[] = {{0, 0},
                                   {-3, 4},
                                   {100, 2600},
                                   {-1, 1 << 20},
                                   {5, 1 << 28},
                                   {0, 1 << 29},
                                   {-kMost / 2, kMost / 2},
                                   {-kMost, kMost}};

TEST(FinerHeights, CentredAreExactAndHeldWhenLowered) {
  for (const HeightRange& range : kRanges) {
    const FinerHeights heights = FinerHeights::Centred(range);
    for (const std::int32_t z : {range.least, heights.zero, range.greatest}) {
      const std::int32_t steps = heights.Scale({1, 2, z}).z;
      EXPECT_EQ(heights.Quanta(steps), static_cast<double>(z) - heights.zero);
      if (heights.most_steps == 0) continue;
      EXPECT_LT(std::abs(std::int64_t{steps}), kLimit);
      EXPECT_LT(std::abs(std::int64_t{steps} - heights.most_steps), kLimit);
    }
  }
}

TEST(FinerHeights, CentredHaveRoomForTwiceTheRange) {
  const FinerHeights heights = FinerHeights::Centred({-1000, 50'000});
  EXPECT_EQ(heights.bits, 10);
  EXPECT_GE(heights.Quanta(heights.most_steps), 2.0 * 51'000);
  EXPECT_EQ(heights.Steps(1.0009), 1024);
  EXPECT_EQ(heights.Steps(-1), 0);
  EXPECT_EQ(heights.Steps(1e12), heights.most_steps);
  EXPECT_EQ(FinerHeights::Centred({0, 1 << 24}).bits, 4);
}

TEST(FinerHeights, FromTheLeastAreAsFineAsAskedForWhereThereIsRoom) {
  for (const HeightRange& range : kRanges) {
    const FinerHeights heights = FinerHeights::FromLeast(range, 0.01);
    const double span = static_cast<double>(range.greatest) - range.least;
    EXPECT_LE(heights.Quanta(1), std::max(0.01, std::ldexp(span, -30)));
    EXPECT_EQ(heights.Scale({0, 0, range.least}).z, 0);
    const Point3i top = heights.Scale({3, 4, range.greatest});
    EXPECT_EQ(heights.Quanta(top.z), span) << "exact, whatever the tolerance";
    EXPECT_GE(heights.most_steps, top.z) << "so an edge lowered by the range is held";
    EXPECT_EQ(FinerHeights::FromLeast(range, 1000).bits, 0) << "never coarser than heights";
    EXPECT_EQ(top.x, 3);
    EXPECT_EQ(top.y, 4);
  }
}

}  // namespace
}  // namespace farhorizon

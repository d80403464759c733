#include "core/io/dem/values/height_quantum.h"

#include <cmath>
#include <limits>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/terrain/dem.h"

namespace farhorizon {
namespace {

using ::testing::ElementsAre;

double ValueOf(const ScaledHeights& scaled, std::size_t i) {
  return scaled.offset + scaled.heights[i] * scaled.quantum;
}

TEST(ScaleHeights, KeepsWholeNumbersUpToThirtyBits) {
  const double top = (1 << 30) - 1;
  const ScaledHeights scaled = ScaleHeights({-top, 0, 2, top});
  EXPECT_THAT(scaled.heights, ElementsAre(-1073741823, 0, 2, 1073741823));
  EXPECT_EQ(scaled.quantum, 1);
  EXPECT_EQ(scaled.offset, 0);
}

TEST(ScaleHeights, SubtractsAnOffsetWhereOnlyTheRangeFits) {
  const double step = std::ldexp(1.0, -20);
  const std::vector<double> values = {5000 + step, 5001, 5002 - 3 * step};
  const ScaledHeights scaled = ScaleHeights(values);
  EXPECT_FALSE(scaled.quantized);
  EXPECT_EQ(scaled.quantum, step);
  EXPECT_NE(scaled.offset, 0);
  for (std::size_t i = 0; i < values.size(); ++i) {
    EXPECT_EQ(ValueOf(scaled, i), values[i]);
    EXPECT_LT(std::abs(scaled.heights[i]), 1 << 30);
  }
}

TEST(ScaleHeights, AnyFloatsOfOneBinadeAreExact) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> draw(1024, 2048);
  std::vector<double> values;
  for (int i = 0; i < 1000; ++i) values.push_back(draw(random));
  const ScaledHeights scaled = ScaleHeights(values);
  EXPECT_FALSE(scaled.quantized);
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_EQ(ValueOf(scaled, i), values[i]);
}

TEST(ScaleHeights, RoundsToTheFinestPowerOfTwoThatThirtyBitsHold) {
  const std::vector<double> values = {1e-300, 1000.1, -999.7};
  const ScaledHeights scaled = ScaleHeights(values);
  EXPECT_TRUE(scaled.quantized);
  // 1000.1 / 2^-20 is just below 2^30: a finer quantum would not do.
  EXPECT_EQ(scaled.quantum, std::ldexp(1.0, -20));
  for (std::size_t i = 0; i < values.size(); ++i) {
    EXPECT_LE(std::abs(ValueOf(scaled, i) - values[i]), scaled.quantum / 2);
  }
}

TEST(ScaleHeights, RoundingNeverReachesTheLimit) {
  const double just_below = std::nextafter(1024.0, 0.0);
  const ScaledHeights scaled = ScaleHeights({just_below, 0.3});
  EXPECT_TRUE(scaled.quantized);
  EXPECT_LT(scaled.heights[0], 1 << 30);
  EXPECT_EQ(scaled.quantum, std::ldexp(1.0, -19));
}

TEST(ScaleHeights, NanIsNoHeight) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(ScaleHeights({nan, 4, nan}).heights, ElementsAre(kNoHeight, 4, kNoHeight));
}

TEST(ScaleHeights, ZeroOfEitherSignIsZero) {
  EXPECT_THAT(ScaleHeights({0.0, -0.0}).heights, ElementsAre(0, 0));
}

}  // namespace
}  // namespace farhorizon

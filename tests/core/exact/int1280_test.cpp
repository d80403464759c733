#include "core/exact/int1280.h"

#include <cmath>
#include <random>

#include <boost/multiprecision/cpp_int.hpp>
#include <gtest/gtest.h>

namespace farhorizon {
namespace {

using BigInt = boost::multiprecision::cpp_int;

// The slow twin, from 100 bits at a time.
struct Twins {
  Int1280 wide;
  BigInt big;
};

Twins RandomTwins(std::mt19937_64& random, int most_pieces) {
  Twins twins{Int1280(), 0};
  const auto pieces = static_cast<int>(random() % static_cast<unsigned>(most_pieces + 1));
  for (int i = 0; i < pieces; ++i) {
    // Pieces of ones and of zeros carry far.
    const std::uint64_t kind = random() % 4;
    Int128 piece = (Int128{static_cast<std::int64_t>(random() >> 14U)} << 50) |
                   Int128{static_cast<std::int64_t>(random() >> 14U)};
    if (kind == 0) piece = 0;
    if (kind == 1) piece = (Int128{1} << 100) - 1;
    twins = {(twins.wide << 100) + Int1280(piece), (twins.big << 100) + BigInt(piece)};
  }
  return random() % 2 == 0 ? twins : Twins{-twins.wide, -twins.big};
}

testing::AssertionResult Same(Int1280 wide, BigInt big) {
  if (SignOf(wide) != big.sign()) return testing::AssertionFailure() << "sign of " << big;
  if (big < 0) {
    wide = -wide;
    big = -big;
  }
  while (big != 0 || SignOf(wide) != 0) {
    if (BigInt(static_cast<Int128>(wide) & ((Int128{1} << 100) - 1)) != big % (BigInt(1) << 100U)) {
      return testing::AssertionFailure() << "the last 100 bits of what is left, " << big;
    }
    wide = wide >> 100;
    big >>= 100U;
  }
  return testing::AssertionSuccess();
}

TEST(Int1280, AddsSubtractsAndMultipliesAsArbitraryPrecisionDoes) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 3000; ++i) {
    const Twins a = RandomTwins(random, 6);
    const Twins b = RandomTwins(random, 6);
    ASSERT_TRUE(Same(a.wide + b.wide, a.big + b.big));
    ASSERT_TRUE(Same(a.wide - b.wide, a.big - b.big));
    ASSERT_TRUE(Same(a.wide * b.wide, a.big * b.big));
    ASSERT_TRUE(Same(-a.wide, -a.big));
    ASSERT_EQ(a.wide < b.wide, a.big < b.big);
    ASSERT_EQ(a.wide == b.wide, a.big == b.big);
    ASSERT_EQ(a.wide <=> a.wide, std::strong_ordering::equal);
  }
}

TEST(Int1280, ShiftsAsArbitraryPrecisionDoesAndRoundsDown) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 3000; ++i) {
    const Twins a = RandomTwins(random, 6);
    const auto count = static_cast<unsigned>(random() % 640);
    ASSERT_TRUE(Same(a.wide << static_cast<int>(count), a.big << count));
    const BigInt divisor = BigInt(1) << count;
    BigInt quotient = a.big / divisor;
    if (quotient * divisor > a.big) --quotient;
    ASSERT_TRUE(Same(a.wide >> static_cast<int>(count), quotient));
  }
}

TEST(Int1280, BecomesTheDoubleNextToIt) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 3000; ++i) {
    const Twins a = RandomTwins(random, 10);
    const auto expected = a.big.convert_to<double>();
    const auto found = static_cast<double>(a.wide);
    ASSERT_LE(std::abs(found - expected), std::abs(expected) * 0x1p-52) << a.big;
  }
  EXPECT_EQ(static_cast<double>(Int1280(-5)), -5);
  EXPECT_EQ(static_cast<double>(Int1280((Int128{1} << 53) - 1)), 0x1.fffffffffffffp52);
}

TEST(Int1280, HoldsThe128BitsItWasMadeOf) {
  for (const Int128 value : {Int128{0}, Int128{-1}, (Int128{1} << 126) + 7, -(Int128{1} << 126)}) {
    EXPECT_TRUE(static_cast<Int128>(Int1280(value)) == value);
    EXPECT_EQ(SignOf(Int1280(value)), SignOf(value));
  }
  EXPECT_EQ(static_cast<std::int64_t>(Int1280(-12)), -12);
}

}  // namespace
}  // namespace farhorizon

#include "core/exact/int1280.h"

#include <cmath>
#include <cstdint>
#include <random>

#include <boost/multiprecision/cpp_int.hpp>
#include <gtest/gtest.h>

#include "core/exact/int128.h"

namespace farhorizon {
namespace {

using BigInt = boost::multiprecision::cpp_int;

// The same number twice, from 100 bits at a time.
struct Twins {
  Int1280 fixed;
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
    twins = {(twins.fixed << 100) + Int1280(piece), (twins.big << 100) + BigInt(piece)};
  }
  return random() % 2 == 0 ? twins : Twins{-twins.fixed, -twins.big};
}

testing::AssertionResult Same(const Int1280& fixed, const BigInt& big) {
  if (SignOf(fixed) != big.sign()) return testing::AssertionFailure() << "sign of " << big;
  if (BigInt(fixed) == big) return testing::AssertionSuccess();
  return testing::AssertionFailure() << fixed << " for " << big;
}

TEST(Int1280, AddsSubtractsAndMultipliesAsArbitraryPrecisionDoes) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 3000; ++i) {
    const Twins a = RandomTwins(random, 6);
    const Twins b = RandomTwins(random, 6);
    ASSERT_TRUE(Same(a.fixed + b.fixed, a.big + b.big));
    ASSERT_TRUE(Same(a.fixed - b.fixed, a.big - b.big));
    ASSERT_TRUE(Same(a.fixed * b.fixed, a.big * b.big));
    ASSERT_TRUE(Same(-a.fixed, -a.big));
    ASSERT_EQ(a.fixed < b.fixed, a.big < b.big);
    ASSERT_EQ(a.fixed == b.fixed, a.big == b.big);
  }
}

TEST(Int1280, ShiftsAsArbitraryPrecisionDoesAndRoundsDown) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 3000; ++i) {
    const Twins a = RandomTwins(random, 6);
    const auto count = static_cast<unsigned>(random() % 640);
    ASSERT_TRUE(Same(a.fixed << static_cast<int>(count), a.big << count));
    const BigInt divisor = BigInt(1) << count;
    BigInt quotient = a.big / divisor;
    if (quotient * divisor > a.big) --quotient;
    ASSERT_TRUE(Same(a.fixed >> static_cast<int>(count), quotient));
  }
}

TEST(Int1280, BecomesTheDoubleNextToIt) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 3000; ++i) {
    const Twins a = RandomTwins(random, 10);
    const auto found = static_cast<double>(a.fixed);
    if (SignOf(a.fixed) == 0) {
      ASSERT_EQ(found, 0);
      continue;
    }
    int exponent = 0;
    const auto digits = static_cast<std::int64_t>(std::ldexp(std::frexp(found, &exponent), 53));
    const BigInt unit = BigInt(1) << static_cast<unsigned>(std::max(exponent - 53, 0));
    const BigInt exactly = exponent >= 53 ? BigInt(digits) * unit
                                          : BigInt(digits) >> static_cast<unsigned>(53 - exponent);
    ASSERT_LE(abs(BigInt(exactly - a.big)), unit) << a.big;
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

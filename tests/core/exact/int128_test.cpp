#include "core/exact/int128.h"

#include <random>

#include <boost/multiprecision/cpp_int.hpp>
#include <gtest/gtest.h>

namespace farhorizon {
namespace {

using boost::multiprecision::cpp_int;

Int128 RandomWide(std::mt19937_64& random) {
  const int bits = static_cast<int>(random() % 127);
  Int128 value = (Int128{static_cast<std::int64_t>(random() >> 1U)} << 64) |
                 Int128{static_cast<std::int64_t>(random() >> 1U)};
  value >>= 126 - bits;
  return random() % 2 == 0 ? value : -value;
}

TEST(CompareProducts, AgreesWithArbitraryPrecision) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 20000; ++i) {
    const Int128 a = RandomWide(random);
    const Int128 b = RandomWide(random);
    const Int128 c = RandomWide(random);
    const Int128 d = RandomWide(random);
    const cpp_int difference = cpp_int(a) * cpp_int(b) - cpp_int(c) * cpp_int(d);
    ASSERT_EQ(CompareProducts(a, b, c, d), difference.sign());
  }
}

TEST(CompareProducts, SeesADifferenceOfOneInTheLastPlace) {
  const Int128 big = (Int128{1} << 126) - 1;
  EXPECT_EQ(CompareProducts(big, big, big, big), 0);
  EXPECT_EQ(CompareProducts(big, big, big, big - 1), 1);
  EXPECT_EQ(CompareProducts(-big, big, big, -big), 0);
  EXPECT_EQ(CompareProducts(-big, big, -big, big - 1), -1);
}

}  // namespace
}  // namespace farhorizon

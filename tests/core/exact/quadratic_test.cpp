#include "core/exact/quadratic.h"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

// Roots by the formula in long double: good enough to order roots that are apart.
std::vector<long double> RootsByFormula(const Quadratic& q) {
  const auto a = static_cast<long double>(q.c2);
  const auto b = static_cast<long double>(q.c1);
  const auto c = static_cast<long double>(q.c0);
  if (a == 0) return b == 0 ? std::vector<long double>{} : std::vector<long double>{-c / b};
  const long double d = b * b - 4 * a * c;
  if (d < 0) return {};
  const long double first = (-b - std::sqrt(d)) / (2 * a);
  const long double second = (-b + std::sqrt(d)) / (2 * a);
  return {std::min(first, second), std::max(first, second)};
}

Quadratic RandomQuadratic(std::mt19937_64& random, int size) {
  const auto draw = [&] {
    return Int128{static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(2 * size + 1)) -
                  size};
  };
  return {draw(), draw(), draw()};
}

TEST(SignAt, IsTheSameInNarrowAndInWideArithmetic) {
  std::mt19937_64 random(2);
  for (int i = 0; i < 2000; ++i) {
    const Quadratic q = RandomQuadratic(random, 1000);
    const auto n = static_cast<std::int64_t>(random() % 1025);
    const Dyadic narrow{n, 10};
    const Dyadic wide{Int128{n} << 40, 50};
    ASSERT_EQ(SignAt(q, narrow), SignAt(q, wide));
  }
}

TEST(CompareRoots, AgreesWithTheFormulaWhereTheyAreApart) {
  std::mt19937_64 random(3);
  int compared = 0;
  for (int i = 0; i < 20000; ++i) {
    const Quadratic p = RandomQuadratic(random, 20);
    const Quadratic q = RandomQuadratic(random, 20);
    const std::vector<long double> r = RootsByFormula(p);
    const std::vector<long double> s = RootsByFormula(q);
    for (std::size_t j = 0; j < r.size(); ++j) {
      for (std::size_t k = 0; k < s.size(); ++k) {
        if (r[j] < 0 || r[j] > 1 || s[k] < 0 || s[k] > 1) continue;
        const long double difference = r[j] - s[k];
        const int sign = Compare(QuadraticRoot{p, j == 1}, QuadraticRoot{q, k == 1});
        ++compared;
        // With coefficients up to 20, roots that are nearer than this are one number.
        const int expected = std::abs(difference) < 1e-9L ? 0 : (difference > 0 ? 1 : -1);
        ASSERT_EQ(sign, expected);
      }
    }
  }
  EXPECT_GT(compared, 1000);
}

TEST(CompareRoots, OneNumberFromDifferentPolynomialsIsEqual) {
  // 2 t^2 - 1 and (2 t^2 - 1) times -3: sqrt(1/2); and 5 (t - 1/3), (3 t - 1)(t - 7).
  const QuadraticRoot half_root{{-1, 0, 2}, true};
  const QuadraticRoot same{{3, 0, -6}, true};
  EXPECT_EQ(Compare(half_root, same), 0);
  const QuadraticRoot third{{-5, 15, 0}, false};
  const QuadraticRoot third_too{{7, -22, 3}, false};
  EXPECT_EQ(Compare(third, third_too), 0);
  EXPECT_LT(Compare(third, half_root), 0);
}

TEST(ApproximateRoot, IsWithinItsErrorWhereItIsReliable) {
  std::mt19937_64 random(4);
  int reliable = 0;
  for (int i = 0; i < 20000; ++i) {
    const Quadratic p = RandomQuadratic(random, i % 2 == 0 ? 20 : 1'000'000);
    const std::vector<long double> roots = RootsByFormula(p);
    for (std::size_t j = 0; j < roots.size(); ++j) {
      const RootEstimate estimate = ApproximateRoot({p, j == 1});
      if (!estimate.reliable) continue;
      ++reliable;
      const long double most = kRootEstimateError * std::max(1.0L, std::abs(roots[j]));
      ASSERT_LE(std::abs(estimate.value - roots[j]), most);
    }
  }
  EXPECT_GT(reliable, 10000);
  // (t - 1)^2 - 2^-80: nothing of the discriminant is left in doubles.
  const Int128 one = Int128{1} << 80;
  EXPECT_FALSE(ApproximateRoot({{one - 1, -2 * one, one}, true}).reliable);
  EXPECT_EQ(DiscriminantSign({one - 1, -2 * one, one}), 1);
}

TEST(Proportional, IsAMultipleOfEitherSign) {
  EXPECT_TRUE(Proportional({1, -2, 3}, {-2, 4, -6}));
  EXPECT_TRUE(Proportional({0, 5, 0}, {0, -1, 0}));
  EXPECT_FALSE(Proportional({1, -2, 3}, {1, -2, 4}));
  const Int128 large = Int128{1} << 103;
  EXPECT_FALSE(Proportional({large, large, large}, {large, large, large - 1}));
}

TEST(Between, FindsTheCoarsestDyadicNumber) {
  const QuadraticRoot third{{-1, 3, 0}, false};
  const QuadraticRoot half_root{{-1, 0, 2}, true};
  const auto middle = Between(third, half_root);
  ASSERT_TRUE(middle);
  EXPECT_EQ(middle->ToDouble(), 0.5);
  EXPECT_FALSE(Between(half_root, third));
  EXPECT_FALSE(Between(third, third));
}

// sqrt(1/2) and a rational number next to it, from a convergent of Pell's equation: apart by some
// 2^-202.
TEST(CompareRoots, TellsApartNumbersThatAgreeInTwoHundredBits) {
  Int128 p = 1;
  Int128 q = 1;  // p / q to sqrt(2)
  int turns = 0;
  while (q < (Int128{1} << 99)) {
    const Int128 next = p + 2 * q;
    q = p + q;
    p = next;
    ++turns;
  }
  const QuadraticRoot root{{-1, 0, 2}, true};
  const QuadraticRoot convergent{{-q, p, 0}, false};  // q / p
  const int expected = turns % 2 == 0 ? -1 : 1;       // p / q is above sqrt(2) after an odd number
  EXPECT_EQ(Compare(root, convergent), expected);
  EXPECT_EQ(Compare(convergent, root), -expected);
  const QuadraticRoot& low = expected < 0 ? root : convergent;
  const QuadraticRoot& high = expected < 0 ? convergent : root;
  const auto between = Between(low, high);
  ASSERT_TRUE(between);
  EXPECT_GT(between->k, 190);
  EXPECT_LT(between->k, 210);
  EXPECT_LT(Compare(low, *between), 0);
  EXPECT_GT(Compare(high, *between), 0);
  EXPECT_FALSE(Between(high, low));
}

TEST(SignAt, IsTheSameForANumberOfEitherKind) {
  std::mt19937_64 random(5);
  for (int i = 0; i < 2000; ++i) {
    const Quadratic q = RandomQuadratic(random, 1000);
    const Dyadic t{static_cast<std::int64_t>(random() % 1025), 10};
    ASSERT_EQ(SignAt(q, t), SignAt(q, Widened(t)));
    if (SignAt(q, t) < 0) continue;
    const NonNegativeRange narrow = NonNegativeAround(q, t);
    const NonNegativeRange wide = NonNegativeAround(q, Widened(t));
    ASSERT_EQ(narrow.from.has_value(), wide.from.has_value());
    ASSERT_EQ(narrow.to.has_value(), wide.to.has_value());
    ASSERT_EQ(narrow.from && narrow.from->upper, wide.from && wide.from->upper);
    ASSERT_EQ(narrow.to && narrow.to->upper, wide.to && wide.to->upper);
  }
}

TEST(NonNegativeAround, EndsWhereThePolynomialTurnsNegative) {
  // (t - 1/4)(3/4 - t) * 16
  const NonNegativeRange hill = NonNegativeAround({-3, 16, -16}, Dyadic{1, 1});
  ASSERT_TRUE(hill.from && hill.to);
  EXPECT_EQ(Compare(*hill.from, Dyadic{1, 2}), 0);
  EXPECT_EQ(Compare(*hill.to, Dyadic{3, 2}), 0);
  // Its opposite, left of the lower root.
  const NonNegativeRange valley = NonNegativeAround({3, -16, 16}, Dyadic{1, 3});
  EXPECT_FALSE(valley.from);
  ASSERT_TRUE(valley.to);
  EXPECT_EQ(Compare(*valley.to, Dyadic{1, 2}), 0);
  // -(2 t - 1)^2 is not negative at 1/2 alone; its opposite never is.
  EXPECT_TRUE(NonNegativeAround({-1, 4, -4}, Dyadic{1, 1}).point);
  const NonNegativeRange everywhere = NonNegativeAround({1, -4, 4}, Dyadic{1, 1});
  EXPECT_FALSE(everywhere.point || everywhere.from || everywhere.to);
}

}  // namespace
}  // namespace farhorizon

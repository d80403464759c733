#include "core/exact/isolated_root.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

// The signs of q between its roots, by points between them.
std::vector<int> SignsBetween(const Quadratic& q, const RootPair& roots) {
  std::vector<IsolatedRoot> cuts = {IsolatedRoot::Zero()};
  cuts.insert(cuts.end(), roots.begin(), roots.end());
  cuts.push_back(IsolatedRoot::One());
  std::vector<int> signs;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    signs.push_back(PointBetween(cuts[i], cuts[i + 1]).Sign(q));
  }
  return signs;
}

// The sign at every multiple of 1/1024 is that of the interval between roots, and signs alternate.
void ExpectAllSignChanges(const Quadratic& q) {
  const RootPair roots = SignChanges(q);
  std::size_t interval = 0;
  const std::vector<int> signs = SignsBetween(q, roots);
  for (std::size_t i = 0; i + 1 < signs.size(); ++i) ASSERT_EQ(signs[i] * signs[i + 1], -1);
  for (std::int64_t n = 1; n < 1024; ++n) {
    while (interval < roots.size() && Compare(roots[interval].root, Dyadic{n, 10}) < 0) ++interval;
    const int sign = SignAt(q, Dyadic{n, 10});
    // Zero at a root, or where the polynomial touches the axis.
    if (sign == 0) continue;
    ASSERT_EQ(sign, signs[interval]) << static_cast<int>(q.c0) << ' ' << static_cast<int>(q.c1)
                                     << ' ' << static_cast<int>(q.c2) << " at " << n;
  }
}

TEST(SignChanges, AreAllThereAreOfEverySmallPolynomial) {
  constexpr int kMost = 6;
  for (int c0 = -kMost; c0 <= kMost; ++c0) {
    for (int c1 = -kMost; c1 <= kMost; ++c1) {
      for (int c2 = -kMost; c2 <= kMost; ++c2) {
        const Quadratic q{c0, c1, c2};
        if (!q.IsZero()) ExpectAllSignChanges(q);
      }
    }
  }
}

TEST(SignChanges, LeaveOutWhereThePolynomialOnlyTouchesZero) {
  EXPECT_TRUE(SignChanges({1, -4, 4}).empty());   // (1 - 2 t)^2
  EXPECT_TRUE(SignChanges({0, 0, 0}).empty());    // zero everywhere
  EXPECT_TRUE(SignChanges({0, 1, -1}).empty());   // at the ends only
  EXPECT_EQ(SignChanges({0, 1, -2}).size(), 1U);  // at 0 and at 1/2
}

TEST(IsolatedRoot, HasTheRootInItsBracketAndNearIt) {
  std::mt19937_64 random(1);
  int isolated = 0;
  for (int i = 0; i < 4000; ++i) {
    const int bits = 4 + i % 90;
    const auto draw = [&] {
      const Int128 value = (Int128{static_cast<std::int64_t>(random())} << 40) ^
                           Int128 { static_cast<std::int64_t>(random()) };
      return value >> (104 - bits);
    };
    for (const IsolatedRoot& root : SignChanges({draw(), draw(), draw()})) {
      ++isolated;
      const auto at = [](double t, int k) {
        return Dyadic{Int128{static_cast<std::int64_t>(std::ldexp(t, k))}, k};
      };
      ASSERT_GE(Compare(root.root, at(root.lo, kBracketBits)), 0);
      ASSERT_LE(Compare(root.root, at(root.hi, kBracketBits)), 0);
      const double value = root.ToDouble();
      const double reach = std::ldexp(1.0, -47);
      ASSERT_GE(Compare(root.root, at(std::max(value - reach, 0.0), 60)), 0);
      ASSERT_LE(Compare(root.root, at(std::min(value + reach, 1.0), 60)), 0);
    }
  }
  EXPECT_GT(isolated, 1000);
}

TEST(IsolatedRoot, IsExactWhereTwoNearlyCoincide) {
  // (a t - b)^2 = 1 with a = 2^49, b = a / 3: roots 2^-48 apart.
  const Int128 a = Int128{1} << 49;
  const Int128 b = a / 3;
  const RootPair roots = SignChanges({b * b - 1, -2 * a * b, a * a});
  ASSERT_EQ(roots.size(), 2U);
  EXPECT_EQ(Compare(roots[0], roots[1]), -1);
  EXPECT_NEAR(roots[0].ToDouble(), 1.0 / 3, 1e-14);
  EXPECT_EQ(PointBetween(roots[0], roots[1]).Sign({b * b - 1, -2 * a * b, a * a}), -1);
}

TEST(IsolatedRoot, IsRefinedToAnyNumberOfBits) {
  const IsolatedRoot third = SignChanges({-1, 3, 0})[0];
  for (const int bits : {kBracketBits, 70, 144, kMaxWideDyadicBits}) {
    const WideDyadic low = Refined(third, bits);
    EXPECT_LE(low.k, bits);
    EXPECT_GE(Compare(third.root, low), 0);
    EXPECT_LE(Compare(third.root, WideDyadic{(low.n << (bits - low.k)) + 1, bits}), 0);
  }
  EXPECT_EQ(Refined(IsolatedRoot::One(), 144).ToDouble(), 1);
  const IsolatedRoot dyadic = SignChanges({-5, 1 << 30, 0})[0];
  EXPECT_EQ(Compare(dyadic.root, Refined(dyadic, 144)), 0);
}

TEST(CompareIsolatedRoots, FindsOneNumberFromTwoPolynomialsEqual) {
  const IsolatedRoot third = SignChanges({-1, 3, 0})[0];
  EXPECT_EQ(Compare(third, SignChanges({2, -6, 0})[0]), 0);
  EXPECT_EQ(Compare(third, SignChanges({-2, 5, 3})[0]), 0);  // (3 t - 1)(t + 2)
  EXPECT_EQ(Compare(third, SignChanges({-1'000'001, 3'000'000, 0})[0]), -1);
  EXPECT_EQ(Compare(IsolatedRoot::Zero(), IsolatedRoot::Zero()), 0);
  EXPECT_EQ(Compare(IsolatedRoot::One(), third), 1);
}

}  // namespace
}  // namespace farhorizon

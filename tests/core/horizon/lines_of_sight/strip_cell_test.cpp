#include "core/horizon/lines_of_sight/strip_cell.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

// The sine of the angle between two vectors.
double SineBetween(const PlanVector& a, const PlanVector& b) {
  return std::abs(Cross(a, b)) / (std::hypot(a.x, a.y) * std::hypot(b.x, b.y));
}

// At t = n / d the vector a + b t is (a d + b n) / d, and a is the nearest integer vector to -b t,
// or one beside it: the vector is some 2^-49 of its size.
TEST(DirectionAt, IsTrueWhereTheVectorNearlyVanishes) {
  std::mt19937_64 random(15);
  const auto any = [&random](std::int64_t least, std::int64_t greatest) {
    return std::uniform_int_distribution<std::int64_t>(least, greatest)(random);
  };
  constexpr std::int64_t kMost = std::int64_t{1} << 49;
  double worst_by_doubles = 0;
  for (int round = 0; round < 100; ++round) {
    const std::int64_t d = any(1 << 20, 1 << 30);
    const std::int64_t n = any(1, d - 1);
    // d t - n, and that times t + 2.
    const Quadratic q = round % 2 == 0 ? Quadratic{-n, d, 0} : Quadratic{-2 * n, 2 * d - n, d};
    const RootPair roots = SignChanges(q);
    ASSERT_EQ(roots.size(), 1U);
    MovingVector v{0, 0, any(-kMost, kMost), any(-kMost, kMost)};
    v.ax = static_cast<std::int64_t>(-Int128{v.bx} * n / d) + any(-1, 1);
    v.ay = static_cast<std::int64_t>(-Int128{v.by} * n / d) + any(-1, 1);
    if (Int128{v.ax} * v.by == Int128{v.ay} * v.bx) continue;
    const PlanVector exact{static_cast<double>(Int128{v.ax} * d + Int128{v.bx} * n),
                           static_cast<double>(Int128{v.ay} * d + Int128{v.by} * n)};
    const PlanVector direction = DirectionAt(v, roots[0]);
    EXPECT_GT(Dot(direction, exact), 0);
    EXPECT_LT(SineBetween(direction, exact), 0x1p-36);
    const PlanVector by_doubles = EndVectorsOf(v, roots[0].ToDouble(), 0).start;
    worst_by_doubles = std::max(worst_by_doubles, SineBetween(by_doubles, exact));
  }
  EXPECT_GT(worst_by_doubles, 0.01);
}

TEST(DirectionAt, IsExactAtTheEndsOfTheEdge) {
  const MovingVector v{(std::int64_t{1} << 49) + 1, -3, -(std::int64_t{1} << 49), 4};
  EXPECT_EQ(DirectionAt(v, IsolatedRoot::One()).x, 1);
  EXPECT_EQ(DirectionAt(v, IsolatedRoot::One()).y, 1);
  EXPECT_EQ(DirectionAt(v, IsolatedRoot::Zero()).y, -3);
}

}  // namespace
}  // namespace farhorizon

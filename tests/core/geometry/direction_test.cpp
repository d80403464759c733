#include "core/geometry/direction.h"

#include <random>

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

Vector RandomVector(std::mt19937_64& random, int size) {
  while (true) {
    const Vector v{static_cast<int>(random() % static_cast<unsigned>(2 * size + 1)) - size,
                   static_cast<int>(random() % static_cast<unsigned>(2 * size + 1)) - size};
    if (!v.IsZero()) return v;
  }
}

TEST(CompareAngle, OrdersDirectionsByTheirAngleInTheHalfTurn) {
  std::mt19937_64 random(4);
  for (int i = 0; i < 20000; ++i) {
    const Direction a = MakeDirection(RandomVector(random, 6));
    const Direction b = MakeDirection(RandomVector(random, 6));
    const Int128 cross = a.v.x * b.v.y - a.v.y * b.v.x;
    ASSERT_EQ(CompareAngle(a, b, nullptr), -SignOf(cross));
    ASSERT_EQ(CompareAngle(a, b, nullptr), -CompareAngle(b, a, nullptr));
  }
}

TEST(CompareAngle, TellsDirectionsApartThatDoublesCannot) {
  const Int128 big = Int128{1} << 60;
  PredicateCounts counts;
  const Direction a = MakeDirection(Vector{big, big + 1});
  const Direction b = MakeDirection(Vector{big, big + 2});
  EXPECT_LT(CompareAngle(a, b, &counts), 0);
  EXPECT_EQ(counts.exact, 1);
  EXPECT_EQ(CompareAngle(a, a, &counts), 0);
  EXPECT_EQ(counts.tied, 1);
  EXPECT_LT(CompareAngle(FirstDirection(), LastDirection(), &counts), 0);
  EXPECT_EQ(counts.filtered, 1);
}

// The slow twin: tries all vectors by rising size.
Vector SimplestBySearch(const Vector& from, const Vector& to, const Vector& along, int most) {
  for (int size = 1; size <= most; ++size) {
    for (int x = -size; x <= size; ++x) {
      for (int y = -size; y <= size; ++y) {
        const Vector v{x, y};
        if (std::max(std::abs(x), std::abs(y)) == size && CrossSign(from, v) > 0 &&
            CrossSign(v, to) > 0 && CrossSign(v, along) != 0) {
          return v;
        }
      }
    }
  }
  return {};
}

TEST(SimplestBetween, LiesStrictlyBetweenAndIsNotAlongTheSegment) {
  std::mt19937_64 random(5);
  for (int i = 0; i < 3000; ++i) {
    const Vector from = RandomVector(random, 9);
    const Vector to = i % 10 == 0 ? -from : RandomVector(random, 9);
    if (i % 10 != 0 && CrossSign(from, to) <= 0) continue;
    const Vector along = RandomVector(random, 3);
    const Vector simplest = SimplestBetween(from, to, along);
    ASSERT_GT(CrossSign(from, simplest), 0);
    ASSERT_GT(CrossSign(simplest, to), 0);
    ASSERT_NE(CrossSign(simplest, along), 0);
    ASSERT_FALSE(SimplestBySearch(from, to, along, 40).IsZero());
  }
}

// Both sizes of numbers share their code, except for products.
TEST(SimplestBetween, IsTheSameInWideNumbers) {
  std::mt19937_64 random(6);
  const auto widened = [](const Vector& v) { return WideVector{Int1280(v.x), Int1280(v.y)}; };
  for (int i = 0; i < 3000; ++i) {
    const Vector from = RandomVector(random, 1000);
    const Vector to = RandomVector(random, 1000);
    const Vector along = RandomVector(random, 3);
    ASSERT_EQ(CrossSign(from, to), CrossSign(widened(from), widened(to)));
    ASSERT_EQ(DotSign(from, to), DotSign(widened(from), widened(to)));
    ASSERT_EQ(CompareAngle(MakeDirection(from), MakeDirection(to), nullptr),
              CompareAngle(MakeDirection(widened(from)), MakeDirection(widened(to)), nullptr));
    if (CrossSign(from, to) <= 0) continue;
    const Vector narrow = SimplestBetween(from, to, along);
    const WideVector wide = SimplestBetween(widened(from), widened(to), widened(along));
    ASSERT_TRUE(wide.x == Int1280(narrow.x) && wide.y == Int1280(narrow.y));
  }
}

TEST(SimplestBetween, FindsRoomInANarrowGap) {
  const Int128 big = Int128{1} << 28;
  const Vector simplest = SimplestBetween(Vector{big, 1}, {big - 1, 1}, {0, 1});
  EXPECT_EQ(simplest.x, 2 * big - 1);
  EXPECT_EQ(simplest.y, 2);
}

}  // namespace
}  // namespace farhorizon

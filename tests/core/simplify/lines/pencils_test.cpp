#include "core/simplify/lines/pencils.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include <gtest/gtest.h>

#include "tests/support/effort.h"

namespace farhorizon {
namespace {

// Cells: nearer to a line than this, floats may put a place on either side.
constexpr double kBeside = 1e-3;

Place AnyPlace(std::int32_t columns, std::int32_t rows, std::mt19937& random) {
  Place place;
  place.x = static_cast<std::int16_t>(random() % static_cast<unsigned>(columns));
  place.y = static_cast<std::int16_t>(random() % static_cast<unsigned>(rows));
  place.plan = static_cast<float>(random() % 1000);
  place.frame = -1e6F;  // has no say
  return place;
}

double DistanceOf(const Pencils::Pencil& pencil, std::int32_t i, const Place& p) {
  return static_cast<double>(pencil.x) * p.x + static_cast<double>(pencil.y) * p.y -
         static_cast<double>(pencil.shift) - i;
}

void ExpectEveryLineAcross(const Pencils& pencils, const Place& a, const Place& b) {
  std::map<std::int32_t, float> visited;
  pencils.ForEachLineAcross(a, b, [&](std::int32_t line, float height) {
    ASSERT_TRUE(visited.emplace(line, height).second) << "line " << line << " comes twice";
  });
  for (const Pencils::Pencil& pencil : pencils.pencils()) {
    for (std::int32_t i = 0; i < pencil.count; ++i) {
      const std::int32_t line = pencil.first + i;
      const double s = DistanceOf(pencil, i, a);
      const double t = DistanceOf(pencil, i, b);
      ASSERT_NEAR(pencils.Distance(line, a), s, kBeside);
      if (std::abs(s) < kBeside || std::abs(t) < kBeside) continue;
      const auto found = visited.find(line);
      ASSERT_EQ(found != visited.end(), pencils.IsAsked(line) && s * t < 0) << "line " << line;
      if (found == visited.end()) continue;
      const double height =
          static_cast<double>(a.plan) +
          s / (s - t) * (static_cast<double>(b.plan) - static_cast<double>(a.plan));
      ASSERT_NEAR(found->second, height, 0.5);
      ASSERT_NEAR(HeightBetween(a, b, pencils.Distance(line, a), pencils.Distance(line, b)), height,
                  0.5);
    }
  }
}

TEST(Pencils, VisitTheLinesThatASegmentCrossesAndNoOthers) {
  std::mt19937 random(1);
  for (int round = 0; round < Rounds(300); ++round) {
    const auto columns = static_cast<std::int32_t>(2 + random() % 40);
    const auto rows = static_cast<std::int32_t>(2 + random() % 40);
    const std::int32_t directions = 1 << random() % 8;
    Pencils pencils(columns, rows, directions);
    for (int halving = 0; directions >> halving > 0; ++halving) {
      for (int k = 0; k < 4; ++k) {
        const Place a = AnyPlace(columns, rows, random);
        ExpectEveryLineAcross(pencils, a, AnyPlace(columns, rows, random));
        if (testing::Test::HasFatalFailure()) return;
      }
      if (directions >> halving > 1) pencils.Halve();
    }
  }
}

TEST(Pencils, HaveEveryLineAtTheirDistancesThatMeetsTheTile) {
  for (const auto& [columns, rows] : {std::pair{2, 2}, {2, 90}, {50, 3}, {31, 47}}) {
    const Pencils pencils(columns, rows, 64);
    ASSERT_EQ(pencils.pencils().size(), 64U);
    std::int32_t lines = 0;
    for (const Pencils::Pencil& pencil : pencils.pencils()) {
      EXPECT_EQ(pencil.first, lines);
      lines += pencil.count;
      for (std::int32_t i = -1; i <= pencil.count; ++i) {
        double least = 1e9;
        double most = -1e9;
        for (const int x : {0, columns - 1}) {
          for (const int y : {0, rows - 1}) {
            Place corner;
            corner.x = static_cast<std::int16_t>(x);
            corner.y = static_cast<std::int16_t>(y);
            least = std::min(least, DistanceOf(pencil, i, corner));
            most = std::max(most, DistanceOf(pencil, i, corner));
          }
        }
        EXPECT_EQ(least < 0 && most > 0, i >= 0 && i < pencil.count);
      }
    }
    EXPECT_EQ(pencils.lines(), lines);
  }
}

TEST(Pencils, OfSixteenDirectionsAreEightOnceHalved) {
  Pencils pencils(20, 20, 16);
  pencils.Halve();
  int asked = 0;
  for (const Pencils::Pencil& pencil : pencils.pencils()) asked += pencils.IsAsked(pencil.first);
  EXPECT_EQ(asked, 8);
}

}  // namespace
}  // namespace farhorizon

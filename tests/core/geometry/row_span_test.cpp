#include "core/geometry/row_span.h"

#include <algorithm>
#include <array>
#include <random>

#include <gtest/gtest.h>

#include "core/geometry/plan.h"

namespace farhorizon {
namespace {

// Whether p is in the closed triangle, which may be a segment or a point.
bool Covers(const std::array<Point3i, 3>& t, Point3i p) {
  const std::array<std::int64_t, 3> sides = {TwiceArea(t[0], t[1], p), TwiceArea(t[1], t[2], p),
                                             TwiceArea(t[2], t[0], p)};
  const auto [least, greatest] = std::minmax_element(sides.begin(), sides.end());
  if (*least < 0 && *greatest > 0) return false;
  const auto [left, right] = std::minmax({t[0].x, t[1].x, t[2].x});
  const auto [top, bottom] = std::minmax({t[0].y, t[1].y, t[2].y});
  return p.x >= left && p.x <= right && p.y >= top && p.y <= bottom;
}

TEST(SpanOfRow, HasThePostsThatTheTriangleCovers) {
  std::mt19937 random(1);
  const auto any = [&random] { return static_cast<std::int32_t>(random() % 8); };
  for (int round = 0; round < 3000; ++round) {
    const std::array<Point3i, 3> t = {{{any(), any(), 0}, {any(), any(), 0}, {any(), any(), 0}}};
    for (std::int32_t row = -1; row <= 8; ++row) {
      const RowSpan span = SpanOfRow(t, row);
      for (std::int32_t column = -1; column <= 8; ++column) {
        ASSERT_EQ(column >= span.first && column <= span.last, Covers(t, {column, row, 0}));
      }
    }
  }
}

TEST(FloorDivide, RoundsDownForAllSigns) {
  EXPECT_EQ(FloorDivide(7, 2), 3);
  EXPECT_EQ(FloorDivide(-7, 2), -4);
  EXPECT_EQ(FloorDivide(7, -2), -4);
  EXPECT_EQ(FloorDivide(-7, -2), 3);
  EXPECT_EQ(FloorDivide(-6, 2), -3);
  EXPECT_EQ(FloorDivide(0, -5), 0);
}

}  // namespace
}  // namespace farhorizon

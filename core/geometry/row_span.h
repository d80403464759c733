#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <utility>

#include "core/geometry/floor_divide.h"
#include "core/geometry/point.h"

namespace farhorizon {

/// The columns [first, last] of one row of posts that a convex polygon covers in plan; first > last
/// where it covers none. Borders count as covered. Exact.
struct RowSpan {
  std::int64_t first = std::numeric_limits<std::int32_t>::max();
  std::int64_t last = std::numeric_limits<std::int32_t>::min();

  [[nodiscard]] bool IsEmpty() const { return first > last; }

  void IncludePost(std::int64_t column) {
    first = std::min(first, column);
    last = std::max(last, column);
  }

  /// Widens the span by the crossing of the row with the side from a to b. A crossing between two
  /// posts is rounded up for `first` and down for `last`. So, when all sides and corners on the row
  /// have been included, the span has the posts inside the polygon and no others.
  /// Requires: a.y < row < b.y.
  void IncludeCrossing(Point2i a, Point2i b, std::int64_t row) {
    const std::int64_t run = std::int64_t{b.x - a.x} * (row - a.y);
    const std::int64_t rise = b.y - a.y;
    first = std::min(first, a.x - FloorDivide(-run, rise));
    last = std::max(last, a.x + FloorDivide(run, rise));
  }
};

/// The span of one row in a triangle.
inline RowSpan SpanOfRow(const std::array<Point3i, 3>& triangle, std::int64_t row) {
  RowSpan span;
  for (std::size_t k = 0; k < 3; ++k) {
    Point2i a{triangle[k].x, triangle[k].y};
    Point2i b{triangle[(k + 1) % 3].x, triangle[(k + 1) % 3].y};
    if (a.y > b.y) std::swap(a, b);
    if (a.y == row) span.IncludePost(a.x);
    if (b.y == row) span.IncludePost(b.x);
    if (a.y < row && row < b.y) span.IncludeCrossing(a, b, row);
  }
  return span;
}

}  // namespace farhorizon

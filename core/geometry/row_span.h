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

  /// Widens the span by the crossing of the row with the polygon's side from a to b. A crossing
  /// between two posts is rounded up for `first` and down for `last`. So, when all sides have been
  /// included, the span has the posts inside the polygon and no others.
  void Include(Point2i a, Point2i b, std::int64_t row) {
    if (a.y > b.y) std::swap(a, b);
    if (row < a.y || row > b.y) return;
    if (row == a.y) Include(a.x, a.x);
    if (row == b.y) Include(b.x, b.x);
    if (row == a.y || row == b.y) return;
    const std::int64_t run = std::int64_t{b.x - a.x} * (row - a.y);
    const std::int64_t rise = b.y - a.y;
    Include(a.x - FloorDivide(-run, rise), a.x + FloorDivide(run, rise));
  }

 private:
  void Include(std::int64_t at_least, std::int64_t at_most) {
    first = std::min(first, at_least);
    last = std::max(last, at_most);
  }
};

/// The span of one row in a triangle.
inline RowSpan SpanOfRow(const std::array<Point3i, 3>& triangle, std::int64_t row) {
  RowSpan span;
  for (std::size_t k = 0; k < 3; ++k) {
    const Point3i& a = triangle[k];
    const Point3i& b = triangle[(k + 1) % 3];
    span.Include({a.x, a.y}, {b.x, b.y}, row);
  }
  return span;
}

}  // namespace farhorizon

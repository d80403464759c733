#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "core/geometry/point.h"

namespace farhorizon {

/// The columns [first, last] of one row of posts that a triangle covers in plan; first > last where it
/// covers none.
struct RowSpan {
  std::int64_t first = std::numeric_limits<std::int32_t>::max();
  std::int64_t last = std::numeric_limits<std::int32_t>::min();
};

/// Borders count as covered. Exact.
RowSpan SpanOfRow(const std::array<Point3i, 3>& triangle, std::int64_t row);

}  // namespace farhorizon

#include "core/geometry/row_span.h"

#include <algorithm>
#include <utility>

namespace farhorizon {
namespace {

std::int64_t FloorDivide(std::int64_t a, std::int64_t b) {
  return a / b - static_cast<std::int64_t>(a % b != 0 && (a < 0) != (b < 0));
}

// Each side offers its crossing with the row to either end, rounded inwards.
void Include(RowSpan& span, Point3i a, Point3i b, std::int64_t row) {
  if (a.y > b.y) std::swap(a, b);
  if (row < a.y || row > b.y) return;
  if (a.y == b.y) {
    span.first = std::min<std::int64_t>({span.first, a.x, b.x});
    span.last = std::max<std::int64_t>({span.last, a.x, b.x});
    return;
  }
  const std::int64_t run = std::int64_t{b.x - a.x} * (row - a.y);
  const std::int64_t rise = b.y - a.y;
  span.first = std::min(span.first, a.x - FloorDivide(-run, rise));
  span.last = std::max(span.last, a.x + FloorDivide(run, rise));
}

}  // namespace

RowSpan SpanOfRow(const std::array<Point3i, 3>& triangle, std::int64_t row) {
  RowSpan span;
  for (std::size_t k = 0; k < 3; ++k) Include(span, triangle[k], triangle[(k + 1) % 3], row);
  return span;
}

}  // namespace farhorizon

#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "core/terrain/mesh.h"

namespace farhorizon {

/// The part of a row of points that a triangle has, half open: of triangles that tile the plan,
/// each point is in one. A point on the last side of a tiling is in none.
struct RowPart {
  std::int32_t first = 0;
  std::int32_t end = 0;
};

/// How far the points of a grid are from whole columns and rows.
struct GridOffset {
  double column = 0;
  double row = 0;
};

/// Calls visit(row, RowPart) for each row of the points of a columns x rows grid, so far from whole
/// columns and rows, of which the triangle has some.
///
/// Where a side crosses a row is computed from its lower point to its greater one by number, so
/// that both triangles beside it get the same double.
template <typename Visit>
void ForEachRow(const GridMesh& mesh, const std::array<std::int32_t, 3>& triangle,
                GridOffset offset, std::int32_t columns, std::int32_t rows, Visit&& visit) {
  struct Side {
    double x, y, run, rise, top, bottom;
  };
  std::array<Side, 3> sides{};
  double top = 0;
  double bottom = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [i, j] = std::minmax(triangle[k], triangle[(k + 1) % 3]);
    const GridPoint& p = mesh.points[static_cast<std::size_t>(i)];
    const GridPoint& q = mesh.points[static_cast<std::size_t>(j)];
    sides[k] = {p.column,
                p.row,
                q.column - p.column,
                q.row - p.row,
                std::min(p.row, q.row),
                std::max(p.row, q.row)};
    top = k == 0 ? sides[k].top : std::min(top, sides[k].top);
    bottom = k == 0 ? sides[k].bottom : std::max(bottom, sides[k].bottom);
  }
  // The first whole number at or above x, in 0 ... most.
  const auto at_or_above = [](double x, std::int32_t most) {
    if (!(x > 0)) return 0;
    if (x >= most) return most;
    const auto cut = static_cast<std::int32_t>(x);
    return cut < x ? cut + 1 : cut;
  };
  const std::int32_t end_row = at_or_above(bottom - offset.row, rows);
  for (std::int32_t r = at_or_above(top - offset.row, rows); r < end_row; ++r) {
    const double y = r + offset.row;
    double left = 0;
    double right = 0;
    bool crossed = false;
    for (const Side& side : sides) {
      if (!(side.top <= y && y < side.bottom)) continue;
      const double x = side.x + (y - side.y) * side.run / side.rise;
      left = crossed ? std::min(left, x) : x;
      right = crossed ? std::max(right, x) : x;
      crossed = true;
    }
    const RowPart part = {at_or_above(left - offset.column, columns),
                          at_or_above(right - offset.column, columns)};
    if (part.first < part.end) visit(r, part);
  }
}

}  // namespace farhorizon

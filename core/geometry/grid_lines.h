#pragma once

#include <array>
#include <cstdint>

#include "core/geometry/point.h"

namespace farhorizon {

/// Coordinates in the basis of a family of grid lines: (column, row) = i across + j along.
template <typename Number>
struct GridLinePosition {
  Number i;  ///< across the lines: the line's number, where it is whole
  Number j;  ///< along a line: the post's number on it, where it is whole
};

/// A family of parallel grid lines, on which neighbouring posts are joined: rows, columns or one of
/// the two diagonals of the cells. `along` joins neighbouring posts of one line, `across` leads to
/// the next line; together they are a basis of the grid, of determinant 1 or -1.
struct GridLines {
  std::int32_t along_column;
  std::int32_t along_row;
  std::int32_t across_column;
  std::int32_t across_row;
  std::int32_t first;  ///< the least and the greatest number of a line that has posts in the grid
  std::int32_t last;

  /// The post j of line i, which may lie outside the grid.
  [[nodiscard]] Point2i Post(std::int32_t i, std::int32_t j) const {
    return {i * across_column + j * along_column, i * across_row + j * along_row};
  }

  /// Of a point or a vector (x, y). Number: double, or an integer; exact in the latter.
  template <typename Number>
  [[nodiscard]] GridLinePosition<Number> PositionOf(const Number& x, const Number& y) const {
    const Number det(across_column * along_row - across_row * along_column);
    return {(x * Number(along_row) - y * Number(along_column)) * det,
            (y * Number(across_column) - x * Number(across_row)) * det};
  }
};

/// All families of a grid: rows, columns, the diagonals from a post to the next column and row,
/// along which cells are split (core/terrain/terrain.h), and last the other diagonals, on which
/// triangles have edges beside holes only.
inline std::array<GridLines, 4> FamiliesOfGridLines(std::int32_t columns, std::int32_t rows) {
  return {{{1, 0, 0, 1, 0, rows - 1},
           {0, 1, 1, 0, 0, columns - 1},
           {1, 1, 1, 0, -(rows - 1), columns - 1},
           {-1, 1, 1, 0, 0, columns + rows - 2}}};
}

}  // namespace farhorizon

#pragma once

#include <cstdint>
#include <utility>

#include "core/simplify/mesh/place.h"

namespace farhorizon {

/// Whole columns from `first` to before `end`.
struct ColumnRange {
  std::int32_t first;
  std::int32_t end;
};

/// What a triangle has of a row of posts and of the row of cells below it. The ground's two facets
/// of a cell (Terrain) are counted at their centroids, two thirds of a cell to the right of its
/// first corner and one below (right), or one and two (left), by the column of that corner.
struct RowUnderTriangle {
  std::int32_t row;
  ColumnRange posts;
  ColumnRange right_facets;
  ColumnRange left_facets;
};

/// An edge from row to row, from its upper end, whichever triangle asks: the triangles on both
/// sides of it compute the same whole numbers. A column is in steps of 2^-40. A slope is off by a
/// step, and a column after 2^15 rows by less than 2^-24; posts and centroids beside an edge of n
/// rows are 1 / 3n, so 2^-17, away from it or more. What is within 2^-19 is on it.
class EdgeByRows {
 public:
  /// Requires: `from` is not below `to`.
  EdgeByRows(const Place& from, const Place& to) : column_(from.x * kOne - kOnEdge + kOne - 1) {
    if (to.y > from.y) {
      slope_ = static_cast<std::int64_t>(static_cast<double>(kOne) * (to.x - from.x) /
                                         static_cast<double>(to.y - from.y));
    }
    to_right_ = (slope_ - 2 * kOne) / 3;
    to_left_ = (2 * slope_ - kOne) / 3;
  }
  void GoToNextRow() { column_ += slope_; }

  /// The first column at the edge or to the right of it, of this row's posts and facets.
  [[nodiscard]] std::int32_t Post() const { return Whole(column_); }
  [[nodiscard]] std::int32_t RightFacet() const { return Whole(column_ + to_right_); }
  [[nodiscard]] std::int32_t LeftFacet() const { return Whole(column_ + to_left_); }

 private:
  static constexpr int kBits = 40;
  static constexpr std::int64_t kOne = std::int64_t{1} << kBits;
  static constexpr std::int64_t kOnEdge = kOne >> 19;

  static std::int32_t Whole(std::int64_t column) {
    return static_cast<std::int32_t>(column >> kBits);
  }

  std::int64_t column_;
  std::int64_t slope_ = 0;
  std::int64_t to_right_;
  std::int64_t to_left_;
};

/// visit(const RowUnderTriangle&) for each row of triangle abc from above. Half open, as in
/// rasterising: a triangle has its left and upper edges.
template <typename Visit>
void ForEachRowUnder(Place a, Place b, Place c, Visit visit) {
  if (a.y > b.y) std::swap(a, b);
  if (b.y > c.y) std::swap(b, c);
  if (a.y > b.y) std::swap(a, b);
  const bool bends_right = Turn(a, b, c) > 0;
  EdgeByRows left(a, bends_right ? c : b);
  EdgeByRows right(a, bends_right ? b : c);
  for (std::int32_t row = a.y; row < c.y; ++row) {
    if (row == b.y) (bends_right ? right : left) = EdgeByRows(b, c);
    visit(RowUnderTriangle{row,
                           {left.Post(), right.Post()},
                           {left.RightFacet(), right.RightFacet()},
                           {left.LeftFacet(), right.LeftFacet()}});
    left.GoToNextRow();
    right.GoToNextRow();
  }
}

}  // namespace farhorizon

#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/geometry/convex_polygon.h"

namespace farhorizon {

/// The boxes of a scene's hulls, by where they are: those up to kCell posts wide and high in the cell of their
/// least corner, the others, of which disjoint hulls leave room for few, in a list of their own. Where a
/// thousand small hulls stand, what is near one of them is found without a look at all.
class HullIndex {
 public:
  static constexpr std::int32_t kCell = 32;

  HullIndex(std::int32_t columns, std::int32_t rows);

  /// The hull at the next place.
  void Add(const ConvexPolygon& hull);
  /// The one at `place` became larger.
  void Grow(std::int32_t place, const ConvexPolygon& hull);
  /// The one at `place` is gone, the last one takes its place.
  void Drop(std::int32_t place);

  /// Whether the box of the hull at `place` and the one given have a point in common.
  [[nodiscard]] bool Meets(std::int32_t place, Point2i least, Point2i most) const {
    const Entry& e = entries_[static_cast<std::size_t>(place)];
    return e.least.x <= most.x && e.most.x >= least.x && e.least.y <= most.y && e.most.y >= least.y;
  }

  /// The first place that accept(place) is true for, of the hulls whose boxes meet the one given; -1 if none.
  /// The same order for the same changes.
  template <typename Accept>
  [[nodiscard]] std::int32_t Find(Point2i least, Point2i most, const Accept& accept) const {
    std::int32_t found = FindInList(heads_.size() - 1, least, most, accept);
    const std::int32_t first_column = std::max(least.x - kCell, 0) / kCell;
    const std::int32_t last_column = std::min(most.x / kCell, columns_ - 1);
    const std::int32_t last_row = std::min(most.y / kCell, rows_ - 1);
    for (std::int32_t row = std::max(least.y - kCell, 0) / kCell; row <= last_row; ++row) {
      for (std::int32_t column = first_column; column <= last_column && found < 0; ++column) {
        found = FindInList(CellAt(column, row), least, most, accept);
      }
    }
    return found;
  }

 private:
  static constexpr std::int32_t kNone = -1;

  struct Entry {
    Point2i least;
    Point2i most;
    std::size_t list = 0;
    std::int32_t previous = kNone;  ///< in the list
    std::int32_t next = kNone;
  };

  template <typename Accept>
  [[nodiscard]] std::int32_t FindInList(std::size_t list, Point2i least, Point2i most,
                                        const Accept& accept) const {
    std::int32_t place = heads_[list];
    while (place != kNone && !(Meets(place, least, most) && accept(place))) {
      place = entries_[static_cast<std::size_t>(place)].next;
    }
    return place;
  }

  [[nodiscard]] std::size_t CellAt(std::int32_t column, std::int32_t row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }
  [[nodiscard]] Entry& At(std::int32_t place) { return entries_[static_cast<std::size_t>(place)]; }
  [[nodiscard]] std::size_t ListOf(const Entry& entry) const;
  void Link(std::int32_t place);
  void Unlink(std::int32_t place);
  /// The neighbours in its list know it by this place.
  void Rename(std::int32_t place);

  std::int32_t columns_;
  std::int32_t rows_;
  std::vector<std::int32_t> heads_;  ///< of the cells, row by row, and of the large ones
  std::vector<Entry> entries_;       ///< by place
};

}  // namespace farhorizon

#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/geometry/convex_polygon.h"

namespace farhorizon {

/// The bounding boxes of the hulls of a HullScene, by their slots. Boxes up to kCell posts wide and
/// high are in the cell of their least corner; all others, of which disjoint hulls leave room for
/// few, are in a list of their own. So the hulls near a place are found without scanning every
/// hull.
class HullIndex {
 public:
  static constexpr std::int32_t kCell = 32;

  HullIndex(std::int32_t columns, std::int32_t rows);

  /// Adds the hull of the next slot.
  void Add(const ConvexPolygon& hull);
  /// The hull at `slot` has become larger.
  void Grow(std::int32_t slot, const ConvexPolygon& hull);
  /// Removes the hull at `slot`; the last hull moves to this slot.
  void Drop(std::int32_t slot);

  /// Whether the box of the hull at `slot` and the box [least, most] have a point in common.
  [[nodiscard]] bool BoxIntersects(std::int32_t slot, Point2i least, Point2i most) const {
    const Entry& e = entries_[static_cast<std::size_t>(slot)];
    return e.least.x <= most.x && e.most.x >= least.x && e.least.y <= most.y && e.most.y >= least.y;
  }

  /// The first slot for which accept(slot) is true, of the hulls whose boxes intersect the box
  /// [least, most]; -1 if there is none. The order depends only on the sequence of changes.
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
    std::int32_t previous = kNone;  ///< slot in the list
    std::int32_t next = kNone;
  };

  template <typename Accept>
  [[nodiscard]] std::int32_t FindInList(std::size_t list, Point2i least, Point2i most,
                                        const Accept& accept) const {
    std::int32_t slot = heads_[list];
    while (slot != kNone && !(BoxIntersects(slot, least, most) && accept(slot))) {
      slot = entries_[static_cast<std::size_t>(slot)].next;
    }
    return slot;
  }

  [[nodiscard]] std::size_t CellAt(std::int32_t column, std::int32_t row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }
  [[nodiscard]] Entry& At(std::int32_t slot) { return entries_[static_cast<std::size_t>(slot)]; }
  [[nodiscard]] std::size_t ListOf(const Entry& entry) const;
  void Link(std::int32_t slot);
  void Unlink(std::int32_t slot);
  /// Makes the neighbours in the list refer to the entry by this slot.
  void Relink(std::int32_t slot);

  std::int32_t columns_;
  std::int32_t rows_;
  std::vector<std::int32_t> heads_;  ///< of the lists: cells row by row, then large boxes
  std::vector<Entry> entries_;       ///< by slot
};

}  // namespace farhorizon

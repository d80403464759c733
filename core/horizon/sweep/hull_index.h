#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

#include "core/geometry/convex_polygon.h"

namespace farhorizon {

/// The bounding boxes of the hulls of a HullScene, by their slots, in a quadtree over the plan. A
/// hull is in the smallest cell that is as wide and high as its box and contains the box's least
/// corner. So the boxes of a cell, and of all cells below it, are in the square of twice its side
/// from its own least corner on.
///
/// Orders of visits depend only on the sequence of changes.
class HullIndex {
 public:
  HullIndex(std::int32_t columns, std::int32_t rows);

  /// Adds the hull of the next slot.
  void Add(const ConvexPolygon& hull);
  /// The hull at `slot` has become larger.
  void Grow(std::int32_t slot, const ConvexPolygon& hull);
  /// Removes the hull at `slot`; the last hull moves to this slot.
  void Drop(std::int32_t slot);

  /// The first slot for which accept(slot) is true, of the hulls whose boxes intersect the box
  /// [least, most]; -1 if there is none.
  template <typename Accept>
  [[nodiscard]] std::int32_t Find(Point2i least, Point2i most, const Accept& accept) const;
  /// Calls visit(slot) for all of these hulls.
  template <typename Visit>
  void ForEach(Point2i least, Point2i most, const Visit& visit) const {
    static_cast<void>(Find(least, most, [&visit](std::int32_t slot) {
      visit(slot);
      return false;
    }));
  }

  /// Visits the hulls, of the cells at each place those nearest to `from` first, and those of large
  /// cells before those of small ones.
  ///
  /// enter(least, most): whether hulls in this box are visited. visit(slot, least, most), with the
  /// hull's box: false ends the walk.
  template <typename Enter, typename Visit>
  void VisitNearFirst(Point2i from, const Enter& enter, const Visit& visit) const;

 private:
  static constexpr std::int32_t kNone = -1;
  /// Of the smallest cells, in posts: 2^3. Any value is sound.
  static constexpr int kSmallestCellBits = 3;
  /// At most 13 tiers (2^15 posts), of each of which at most three cells wait while the fourth is
  /// walked.
  static constexpr std::size_t kMostPending = 64;

  struct Cell {
    std::int32_t first = kNone;  ///< slot: of the list of the cell's own hulls
    std::int32_t count = 0;      ///< hulls in this cell and those below it
  };
  /// All cells of one size, row by row.
  struct Tier {
    std::int32_t columns;
    std::int32_t rows;
    std::vector<Cell> cells;
  };
  struct CellId {
    std::int32_t tier;  ///< 0: the smallest cells
    std::int32_t x;
    std::int32_t y;
    friend bool operator==(const CellId&, const CellId&) = default;
  };
  struct Entry {
    Point2i least;
    Point2i most;
    CellId cell = {};
    std::int32_t previous = kNone;  ///< slot in the list
    std::int32_t next = kNone;
  };
  struct Pending {
    CellId cell;
    std::int64_t distance;
  };

  [[nodiscard]] std::size_t NumberOf(CellId cell) const {
    return static_cast<std::size_t>(cell.y) *
               static_cast<std::size_t>(tiers_[static_cast<std::size_t>(cell.tier)].columns) +
           static_cast<std::size_t>(cell.x);
  }
  [[nodiscard]] const Cell& CellAt(CellId cell) const {
    return tiers_[static_cast<std::size_t>(cell.tier)].cells[NumberOf(cell)];
  }
  [[nodiscard]] Cell& CellAt(CellId cell) {
    return tiers_[static_cast<std::size_t>(cell.tier)].cells[NumberOf(cell)];
  }
  [[nodiscard]] CellId Root() const { return {static_cast<std::int32_t>(tiers_.size()) - 1, 0, 0}; }
  /// The least corner that a box in the cell, or below it, can have, and the greatest.
  static Point2i LeastOf(CellId cell) {
    const int bits = cell.tier + kSmallestCellBits;
    return {cell.x << bits, cell.y << bits};
  }
  static Point2i MostOf(CellId cell) {
    const int bits = cell.tier + kSmallestCellBits;
    return {(cell.x + 2) << bits, (cell.y + 2) << bits};
  }
  static bool Intersect(Point2i least, Point2i most, Point2i other_least, Point2i other_most) {
    return least.x <= other_most.x && most.x >= other_least.x && least.y <= other_most.y &&
           most.y >= other_least.y;
  }
  /// Calls visit(cell) for each cell right below that has hulls in it or below it.
  template <typename Visit>
  void ForEachBelow(CellId cell, const Visit& visit) const;
  /// The first slot of the cell's own list for which accept(slot) is true; kNone if there is none.
  template <typename Accept>
  [[nodiscard]] std::int32_t FindInList(CellId cell, const Accept& accept) const {
    std::int32_t slot = CellAt(cell).first;
    while (slot != kNone && !accept(slot)) slot = At(slot).next;
    return slot;
  }

  [[nodiscard]] Entry& At(std::int32_t slot) { return entries_[static_cast<std::size_t>(slot)]; }
  [[nodiscard]] const Entry& At(std::int32_t slot) const {
    return entries_[static_cast<std::size_t>(slot)];
  }
  [[nodiscard]] CellId HomeOf(const Entry& entry) const;
  void Count(CellId home, std::int32_t change);
  void Link(std::int32_t slot);
  void Unlink(std::int32_t slot);
  /// Makes the neighbours in the list refer to the entry by this slot.
  void Relink(std::int32_t slot);

  std::vector<Tier> tiers_;
  std::vector<Entry> entries_;  ///< by slot
};

template <typename Visit>
void HullIndex::ForEachBelow(CellId cell, const Visit& visit) const {
  if (cell.tier == 0) return;
  const Tier& below = tiers_[static_cast<std::size_t>(cell.tier) - 1];
  for (std::int32_t child = 0; child < 4; ++child) {
    const CellId id{cell.tier - 1, 2 * cell.x + (child & 1), 2 * cell.y + (child >> 1)};
    if (id.x < below.columns && id.y < below.rows && CellAt(id).count > 0) visit(id);
  }
}

template <typename Accept>
std::int32_t HullIndex::Find(Point2i least, Point2i most, const Accept& accept) const {
  std::array<CellId, kMostPending> stack;
  std::size_t depth = 0;
  if (CellAt(Root()).count > 0) stack[depth++] = Root();
  while (depth > 0) {
    const CellId cell = stack[--depth];
    if (!Intersect(LeastOf(cell), MostOf(cell), least, most)) continue;
    const std::int32_t found = FindInList(cell, [&](std::int32_t slot) {
      return Intersect(At(slot).least, At(slot).most, least, most) && accept(slot);
    });
    if (found != kNone) return found;
    ForEachBelow(cell, [&](CellId below) { stack[depth++] = below; });
  }
  return kNone;
}

template <typename Enter, typename Visit>
void HullIndex::VisitNearFirst(Point2i from, const Enter& enter, const Visit& visit) const {
  const auto distance_to = [from](CellId cell) {
    const Point2i least = LeastOf(cell);
    const Point2i most = LeastOf({cell.tier, cell.x + 1, cell.y + 1});
    const std::int64_t dx = std::max({least.x - from.x, 0, from.x - most.x});
    const std::int64_t dy = std::max({least.y - from.y, 0, from.y - most.y});
    return dx * dx + dy * dy;
  };
  std::array<Pending, kMostPending> stack;
  std::size_t depth = 0;
  if (CellAt(Root()).count > 0) stack[depth++] = {Root(), 0};
  while (depth > 0) {
    const CellId cell = stack[--depth].cell;
    if (!enter(LeastOf(cell), MostOf(cell))) continue;
    const std::int32_t last = FindInList(
        cell, [&](std::int32_t slot) { return !visit(slot, At(slot).least, At(slot).most); });
    if (last != kNone) return;
    const std::size_t base = depth;
    ForEachBelow(cell, [&](CellId below) { stack[depth++] = {below, distance_to(below)}; });
    // The nearest cell goes on top of the stack.
    std::sort(stack.begin() + static_cast<std::ptrdiff_t>(base),
              stack.begin() + static_cast<std::ptrdiff_t>(depth),
              [](const Pending& a, const Pending& b) {
                return std::tuple(a.distance, a.cell.y, a.cell.x) >
                       std::tuple(b.distance, b.cell.y, b.cell.x);
              });
  }
}

}  // namespace farhorizon

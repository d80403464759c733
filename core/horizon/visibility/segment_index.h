#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/geometry/segment.h"

namespace farhorizon {

/// Segments in a quadtree over the plan. Each segment is in the cell that contains its midpoint, in
/// the tier whose cells fit its length, so a few long segments do not slow down the search among
/// many short ones. A node has the bounding box and the greatest height of all segments in its
/// subtree. Erasing a segment leaves both as they are: they stay bounds.
class SegmentIndex {
 public:
  /// A segment with its lower end first.
  struct Item {
    Point3i low;
    Point3i high;
    std::int32_t next = -1;  ///< in the same node
    bool alive = true;
  };
  struct Node {
    std::int32_t min_x;
    std::int32_t min_y;
    std::int32_t max_x;
    std::int32_t max_y;
    std::int32_t top;         ///< the greatest height in the subtree
    std::int32_t first = -1;  ///< of the list of the node's own items

    /// From a point of the plan to the box.
    [[nodiscard]] double SquaredDistance(double x, double y) const {
      const double dx = std::max({min_x - x, 0.0, x - max_x});
      const double dy = std::max({min_y - y, 0.0, y - max_y});
      return dx * dx + dy * dy;
    }
  };

  SegmentIndex(std::int32_t columns, std::int32_t rows);

  std::int32_t Insert(const Segment& segment);
  void Erase(std::int32_t id);
  [[nodiscard]] std::int64_t alive() const { return alive_; }
  [[nodiscard]] const Item& item(std::int32_t id) const {
    return items_[static_cast<std::size_t>(id)];
  }

  /// Visits the items of the tree from its root, of the children of each node the one nearest to
  /// the point (x, y) of the plan first.
  ///
  /// least_top: nodes whose greatest height is less are skipped. enter(node): whether the node's
  /// items and children are visited. visit(id, item): called for each item that is not erased;
  /// false ends the walk. Returns false where visit ended the walk.
  template <typename Enter, typename Visit>
  bool VisitNearFirst(double x, double y, std::int64_t least_top, const Enter& enter,
                      const Visit& visit) const;

 private:
  /// All cells of one size, row by row.
  struct Tier {
    std::int32_t columns;
    std::int32_t rows;
    std::vector<Node> nodes;
  };
  struct CellId {
    std::int32_t tier;  ///< 0: the smallest cells
    std::int32_t x;
    std::int32_t y;
  };
  struct Pending {
    CellId cell;
    double distance;
  };
  /// At most 32 tiers, of each of which at most three cells wait while the fourth is walked.
  static constexpr std::size_t kMostPending = 128;

  [[nodiscard]] const Node& At(CellId cell) const {
    const Tier& tier = tiers_[static_cast<std::size_t>(cell.tier)];
    return tier.nodes[static_cast<std::size_t>(cell.y) * static_cast<std::size_t>(tier.columns) +
                      static_cast<std::size_t>(cell.x)];
  }
  [[nodiscard]] bool Exists(CellId cell) const {
    const Tier& tier = tiers_[static_cast<std::size_t>(cell.tier)];
    return cell.x < tier.columns && cell.y < tier.rows;
  }
  template <typename Visit>
  bool VisitItems(const Node& node, const Visit& visit) const {
    for (std::int32_t id = node.first; id >= 0;) {
      const Item& item = items_[static_cast<std::size_t>(id)];
      if (item.alive && !visit(id, item)) return false;
      id = item.next;
    }
    return true;
  }

  std::vector<Tier> tiers_;
  std::vector<Item> items_;
  std::int64_t alive_ = 0;
};

template <typename Enter, typename Visit>
bool SegmentIndex::VisitNearFirst(double x, double y, std::int64_t least_top, const Enter& enter,
                                  const Visit& visit) const {
  std::array<Pending, kMostPending> stack;
  std::size_t depth = 0;
  stack[depth++] = {{static_cast<std::int32_t>(tiers_.size()) - 1, 0, 0}, 0};
  while (depth > 0) {
    const CellId cell = stack[--depth].cell;
    const Node& node = At(cell);
    if (node.top < least_top || !enter(node)) continue;
    if (!VisitItems(node, visit)) return false;
    if (cell.tier == 0) continue;
    const std::size_t base = depth;
    for (std::int32_t child = 0; child < 4; ++child) {
      const CellId below{cell.tier - 1, 2 * cell.x + (child & 1), 2 * cell.y + (child >> 1)};
      if (!Exists(below)) continue;
      const Node& node_below = At(below);
      if (node_below.top < least_top) continue;
      stack[depth++] = {below, node_below.SquaredDistance(x, y)};
    }
    // The nearest child goes on top of the stack.
    std::sort(stack.begin() + static_cast<std::ptrdiff_t>(base),
              stack.begin() + static_cast<std::ptrdiff_t>(depth),
              [](const Pending& a, const Pending& b) { return a.distance > b.distance; });
  }
  return true;
}

}  // namespace farhorizon

#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/horizon/visibility/occluder_set.h"

namespace farhorizon {

/// Segments in a quadtree over the plan, each in the cell of its midpoint at the level of its
/// length, so that a few long ones among many short ones cost nothing. Nodes know the box and the
/// greatest height of what is below them; erasing leaves both as they are (they are bounds).
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
    std::int32_t top;         ///< greatest height below
    std::int32_t first = -1;  ///< items of this node itself

    /// Of the box from a point of the plan.
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

  /// A node by its level (0 the smallest cells) and its number in the level.
  struct Place {
    std::int32_t level;
    std::int32_t x;
    std::int32_t y;
  };
  [[nodiscard]] Place Root() const { return {static_cast<std::int32_t>(levels_.size()) - 1, 0, 0}; }
  [[nodiscard]] const Node& At(Place place) const {
    const Level& level = levels_[static_cast<std::size_t>(place.level)];
    return level.nodes[static_cast<std::size_t>(place.y) * static_cast<std::size_t>(level.columns) +
                       static_cast<std::size_t>(place.x)];
  }
  [[nodiscard]] bool Exists(Place place) const {
    const Level& level = levels_[static_cast<std::size_t>(place.level)];
    return place.x < level.columns && place.y < level.rows;
  }

 private:
  struct Level {
    std::int32_t columns;
    std::int32_t rows;
    std::vector<Node> nodes;
  };

  std::vector<Level> levels_;
  std::vector<Item> items_;
  std::int64_t alive_ = 0;
};

}  // namespace farhorizon

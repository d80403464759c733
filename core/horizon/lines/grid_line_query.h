#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/terrain/terrain.h"

namespace farhorizon {

/// The greatest height of a terrain's edges over a plan line, and an edge that has it there.
struct HighestEdge {
  double height = 0;  ///< quanta
  Edge edge;
};

/// Finds the highest edge of a terrain over plan lines, by walking along the grid lines that they
/// cross.
/// Threads: any number may ask at once.
class GridLineQuery {
 public:
  /// Requires: `terrain` outlives it. Cost: O(posts).
  explicit GridLineQuery(const Terrain& terrain);

  /// The highest terrain edge, ignoring `except`, over the line through (x, y), a point inside the
  /// grid, along (dx, dy), in columns and rows; nullopt where the line meets no other edge.
  ///
  /// In floating point: a line that passes a post at less than 1e-9 posts counts as through the
  /// post, and meets its edges there. Exact and slow twin: HighestOver (highest_over_line.h).
  /// Cost: O(columns + rows), and little of it where the ground is lower than elsewhere on the
  /// line.
  [[nodiscard]] std::optional<HighestEdge> HighestEdgeOver(Edge except, double x, double y,
                                                           double dx, double dy) const;

 private:
  const Terrain& terrain_;
  bool has_holes_ = false;
  std::int32_t block_columns_;
  // For each block of posts, the greatest height in it and in the blocks around it.
  std::vector<std::int32_t> tops_;
};

}  // namespace farhorizon

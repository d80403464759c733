#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/terrain/terrain.h"

namespace farhorizon {

/// The highest point of a terrain's edges over a plan line, and an edge that has it.
struct HighestEdge {
  double height = 0;  ///< quanta
  Edge edge;
};

/// Walks along plan lines over a terrain. Threads: any number may walk at once.
class GridLineQuery {
 public:
  /// Requires: `terrain` outlives it. Cost: O(posts).
  explicit GridLineQuery(const Terrain& terrain);

  /// What is highest of all edges but one over the line through (x, y), a place above the grid, along (dx, dy),
  /// in columns and rows; nullopt where the line meets no other. In doubles: a line that passes a post by less than 1e-9 posts
  /// goes through it, and meets its edges there.
  /// Exact and slow twin: HighestOver (highest_over_line.h). Cost: O(columns + rows), little of it where the
  /// ground is lower than elsewhere on the line.
  [[nodiscard]] std::optional<HighestEdge> HighestEdgeOver(Edge except, double x, double y,
                                                           double dx, double dy) const;

 private:
  const Terrain& terrain_;
  bool has_holes_ = false;
  std::int32_t block_columns_;
  std::vector<std::int32_t>
      tops_;  // per block of posts the greatest height in it and its neighbours
};

}  // namespace farhorizon

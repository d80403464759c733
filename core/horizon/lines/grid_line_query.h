#pragma once

#include <cstdint>
#include <limits>
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

  /// A plan line through (x, y), a point inside the grid, along (dx, dy), in columns and rows.
  struct Line {
    double x = 0;
    double y = 0;
    double dx = 0;
    double dy = 0;
  };

  /// The highest terrain edge, ignoring `except`, over the line; nullopt where the line meets no
  /// other edge above `floor`, quanta.
  ///
  /// In floating point: a line that passes a post at less than 1e-9 posts counts as through the
  /// post, and meets its edges there. Exact and slow twin: HighestOver (highest_over_line.h).
  /// Cost: O(columns + rows), and little of it where the ground is lower than elsewhere on the
  /// line, or than `floor`.
  [[nodiscard]] std::optional<HighestEdge> HighestEdgeOver(
      Edge except, const Line& line, double floor = -std::numeric_limits<double>::infinity()) const;

  /// Bounds the error of HighestEdge::height, quanta, except that of a line through a post.
  [[nodiscard]] double HeightError() const { return height_error_; }

 private:
  /// The greatest height of the posts of each square block, by rows.
  struct BlockTops {
    std::int32_t columns;
    std::vector<std::int32_t> tops;

    [[nodiscard]] std::int32_t At(std::int32_t column, std::int32_t row) const {
      return tops[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                  static_cast<std::size_t>(column)];
    }
    [[nodiscard]] std::int32_t& At(std::int32_t column, std::int32_t row) {
      return tops[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                  static_cast<std::size_t>(column)];
    }
    /// Of blocks 2^bits as wide.
    [[nodiscard]] BlockTops Coarser(int bits) const;
    /// For each block, of itself and the blocks around it.
    [[nodiscard]] BlockTops OfNeighbourhoods() const;
  };

  const Terrain& terrain_;
  double height_error_ = 0;
  bool has_holes_ = false;
  BlockTops tops_;        ///< of the neighbourhoods of blocks
  BlockTops large_tops_;  ///< of large blocks
};

}  // namespace farhorizon

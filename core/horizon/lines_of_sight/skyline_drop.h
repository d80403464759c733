#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/geometry/finer_heights.h"
#include "core/horizon/horizon.h"
#include "core/horizon/lines/grid_line_query.h"
#include "core/horizon/visibility/segment_index.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// How much the skyline drops where an edge is taken away: over all lines of sight that touch the
/// edge, the greatest difference between the height of the edge and that of the highest other edge
/// of the terrain.
///
/// Threads: any number may ask at once.
class SkylineDrops {
 public:
  /// tolerance: the greatest error wanted, in quanta, above 0.
  /// Requires: `terrain` and `horizon`, FindHorizon's of it, outlive this. Cost: O(posts).
  SkylineDrops(const Terrain& terrain, const Horizon& horizon, double tolerance);

  /// Of the horizon's edge i, in quanta: never above the exact value, and below it by the greatest
  /// of these at most: the tolerance, kRelativeTolerance of the value itself, a step. A step is the
  /// tolerance, or 2^-30 of the terrain's range of heights where that is more, but no more than a
  /// quantum. 0 where horizontal ground ties on every line, and for an undecided edge.
  /// Cost: some ten line queries and ten visibility queries, less than FindLinesOfSight's for one
  /// edge.
  [[nodiscard]] double Of(std::size_t i) const;

  /// The same within some decisions (work_budget.h), and those that it took. `quanta` is empty
  /// where they did not suffice.
  struct Drop {
    std::optional<double> quanta = std::nullopt;
    std::int64_t spent = 0;
  };
  [[nodiscard]] Drop Find(std::size_t i, std::int64_t limit) const;

  static constexpr double kRelativeTolerance = 0x1p-10;

 private:
  class LoweredEdge;
  [[nodiscard]] Segment Scaled(const Segment& segment) const;

  const Terrain& terrain_;
  const Horizon& horizon_;
  double tolerance_;
  GridLineQuery lines_;
  FinerHeights heights_;  // in whose steps edges are lowered
  SegmentIndex skyline_;  // the horizon edges, scaled
};

}  // namespace farhorizon

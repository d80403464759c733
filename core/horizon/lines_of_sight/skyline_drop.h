#pragma once

#include <cstddef>

#include "core/geometry/finer_heights.h"
#include "core/horizon/horizon.h"
#include "core/horizon/lines/grid_line_query.h"
#include "core/horizon/visibility/segment_index.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// How much lower the skyline would be without an edge: the greatest difference, over all lines of sight
/// that touch it, between its height there and that of the highest other edge of the terrain.
///
/// Threads: any number may ask at once.
class SkylineDrops {
 public:
  /// tolerance: how close an answer is to be, in quanta, above 0.
  /// Requires: `terrain` and `horizon`, FindHorizon's of it, outlive this. Cost: O(posts).
  SkylineDrops(const Terrain& terrain, const Horizon& horizon, double tolerance);

  /// That of the horizon's edge i, in quanta: no more than the truth, and less by no more than the
  /// tolerance (or 2^-27 of the terrain's range of heights, where that is more). 0 where level ground ties
  /// everywhere, and for an undecided edge.
  /// Cost: some forty points asked what they see, a few times FindLinesOfSight for one edge.
  [[nodiscard]] double Of(std::size_t i) const;

 private:
  class Sinking;
  [[nodiscard]] Segment Scaled(const Segment& segment) const;

  const Terrain& terrain_;
  const Horizon& horizon_;
  GridLineQuery walk_;
  FinerHeights heights_;  ///< in whose steps edges are lowered
  SegmentIndex skyline_;
};

}  // namespace farhorizon

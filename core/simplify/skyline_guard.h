#pragma once

#include <cstdint>

#include "core/geometry/finer_heights.h"
#include "core/horizon/horizon.h"
#include "core/horizon/visibility/occluder_set.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// Keeps a mesh from rising above the DEM's skyline: says of an edge whether, lowered by an
/// allowance, it is hidden from every distant horizontal direction behind the DEM.
///
/// Asks the DEM's horizon edges only, because they generate H (horizon.md's second conclusion), and
/// chords across the ground that hide much at once.
class SkylineGuard {
 public:
  /// Requires: both outlive the guard.
  SkylineGuard(const Terrain& terrain, const Horizon& horizon);

  /// Exact. Cost: constant for most edges; for the others about the segments in sight.
  [[nodiscard]] bool Hides(VertexId p, VertexId q, std::int32_t steps_lower) const;

  [[nodiscard]] const FinerHeights& scale() const { return scale_; }

 private:
  const Terrain* terrain_;
  const HullMergeTree* hulls_;
  FinerHeights scale_;
  OccluderSet occluders_;
};

}  // namespace farhorizon

#pragma once

#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/horizon/horizon.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// What a plane that descends through the terrain finds out at once.
struct HullSweep {
  std::vector<Edge> candidates;  ///< by rising (a, b); contains every horizon edge
  HullForest hulls;
  HorizonStatistics statistics;
};

/// Sweeps the terrain from its summit down, keeping the merged hulls of the ground at or above the
/// plane, and leaves as candidates the creases that are no valley and whose lower end is outside
/// the hull that their upper end joins.
///
/// Cost: O(n log n) plus, for each vertex that enlarges a hull, the size of the hull and the hulls
/// apart. Errors: kCancelled.
Result<HullSweep> SweepHulls(const Terrain& terrain, const Watch& watch);

}  // namespace farhorizon

#pragma once

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/horizon/horizon.h"
#include "core/horizon/sweep/hull_history.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// The merged hulls of the ground at or above a plane that falls through the terrain past its
/// vertices, by falling height and rising number (core/horizon/README.md, theorem 4).
struct HullSweep {
  HullHistory history;  ///< its first state is at the summit
  HullMergeTree hulls;
  HorizonStatistics statistics;
};

/// Sweeps the terrain from its summit down.
///
/// The same for any number of threads, which only sort the vertices.
/// Cost: O(n log n) and, for each vertex that extends a hull, the corners of the hull and the hulls
/// nearby. Some 20 bytes a post. Errors: kCancelled.
Result<HullSweep> SweepHulls(const Terrain& terrain, int threads, const RunControl& control);

}  // namespace farhorizon

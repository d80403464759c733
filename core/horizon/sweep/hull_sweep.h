#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/horizon/horizon.h"
#include "core/horizon/sweep/hull_scene.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// What a plane that descends through the terrain, past its vertices by falling height and rising number,
/// saw of the merged hulls of the ground at or above it.
///
/// Its changes can be made again from each of its checkpoints on.
struct HullSweep {
  struct Change {
    HullChange hulls;
    VertexId by = 0;  ///< the vertex that the plane met
  };
  struct Checkpoint {
    VertexId vertex = 0;          ///< that comes next
    std::size_t next_change = 0;  ///< the first that it, or a later one, makes
    HullScene scene;              ///< before it
  };

  std::vector<Change> changes;          ///< in order
  std::vector<Checkpoint> checkpoints;  ///< in order; the first one is the summit
  HullMergeTree hulls;
  HorizonStatistics statistics;
};

/// Sweeps the terrain from its summit down.
///
/// The same for any `threads`, which share what can be known of a vertex by itself.
/// Cost: O(n log n) plus, for each vertex that enlarges a hull, the size of the hull and the hulls
/// apart. Errors: kCancelled.
Result<HullSweep> SweepHulls(const Terrain& terrain, int threads, const Watch& watch);

}  // namespace farhorizon

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/horizon/horizon.h"
#include "core/horizon/sweep/hull_scene.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// The history of the merged hulls of the ground at or above a plane that falls through the terrain
/// past its vertices, by falling height and rising number (core/horizon/README.md, theorem 4). The
/// changes can be replayed from each checkpoint on.
struct HullSweep {
  struct Change {
    HullChange hulls;
    VertexId by = 0;  ///< the vertex at which it happened
  };
  /// A state of the sweep.
  struct Checkpoint {
    VertexId vertex = 0;          ///< the next vertex
    std::size_t next_change = 0;  ///< the first change at that vertex or a later one
    HullScene scene;              ///< the hulls before that vertex
  };

  std::vector<Change> changes;          ///< in order
  std::vector<Checkpoint> checkpoints;  ///< in order; the first is at the summit
  HullMergeTree hulls;
  HorizonStatistics statistics;
};

/// Sweeps the terrain from its summit down.
///
/// The same for any number of threads, which only sort the vertices.
/// Cost: O(n log n) and, for each vertex that extends a hull, the size of the hull and the hulls
/// nearby. Errors: kCancelled.
Result<HullSweep> SweepHulls(const Terrain& terrain, int threads, const RunControl& control);

}  // namespace farhorizon

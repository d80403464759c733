#pragma once

#include <vector>

#include "core/horizon/hull_merge_tree.h"
#include "core/horizon/statistics.h"
#include "core/horizon/virtual_occluder_table.h"
#include "core/horizon/witness.h"
#include "core/terrain/mesh.h"

namespace farhorizon {

/// An edge of the terrain on the distant horizon, with a line of sight that shows it.
struct HorizonEdge {
  Edge edge;
  Witness witness;  ///< t runs from edge.a to edge.b
  /// The edge is kept because the work budget ran out before it was decided: `witness` has no
  /// meaning.
  bool undecided = false;
};

/// What FindHorizon finds.
struct Horizon {
  std::vector<HorizonEdge> edges;  ///< by rising (a, b)
  /// For each edge: segments that do not rise above the skyline and that occlude most of the
  /// directions in which the edge is not visible. They save time where more is asked about an edge;
  /// no answer depends on them (core/horizon/README.md, corollary 2a).
  VirtualOccluderTable virtual_occluders;
  HorizonStatistics statistics;
  HullMergeTree hulls;
};

}  // namespace farhorizon

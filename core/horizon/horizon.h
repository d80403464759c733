#pragma once

#include <cstddef>
#include <vector>

#include "core/geometry/segment.h"
#include "core/horizon/hull_merge_tree.h"
#include "core/horizon/statistics.h"
#include "core/horizon/witness.h"
#include "core/terrain/mesh.h"

namespace farhorizon {

/// An edge of the terrain that lies on the distant horizon of some horizontal line of sight, with
/// one such line. witness.t runs from a to b.
struct HorizonEdge {
  Edge edge;
  Witness witness;
  bool undecided = false;  ///< kept because the work budget ran out: the witness says nothing
};

struct Horizon {
  std::vector<HorizonEdge> edges;  ///< by rising (a, b)
  /// For the edge i those from virtual_occluder_ends[i - 1] (0 for the first) up to virtual_occluder_ends[i]: segments that
  /// do not rise above the skyline and hide much of what the edge cannot see. They only save time.
  std::vector<Segment> virtual_occluders;
  std::vector<std::size_t> virtual_occluder_ends;
  HorizonStatistics statistics;
  HullMergeTree hulls;
};

}  // namespace farhorizon

#pragma once

#include <cstdint>
#include <vector>

#include "core/terrain/dem.h"

namespace farhorizon {

/// The level at which each post disappears inside a merged hull, and in which one: a bound from
/// below on the height of the visual hull, good for a quick and certain "hidden".
class HullMergeTree {
 public:
  /// True only if every line of sight that crosses the segment between posts u and w meets ground at
  /// or above `level`: at the segment's greatest height, the segment may stand in any mesh without
  /// raising the skyline. False: not known.
  [[nodiscard]] bool Hides(VertexId u, VertexId w, std::int32_t level) const;

  std::vector<std::int32_t> enclosed_height;  ///< per post; kNoHeight where never
  std::vector<std::int32_t> cluster;       ///< per post: node of the forest it was covered by; -1
  std::vector<std::int32_t> parent;        ///< per node: the node it merged into; -1 at a root
  std::vector<std::int32_t> merge_height;  ///< per node: the level at which it did
};

}  // namespace farhorizon

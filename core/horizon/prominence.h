#pragma once

#include "core/horizon/sights.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// How much lower the skyline would be without an edge. Threads: any number may ask at once.
class Prominences {
 public:
  /// Requires: `terrain` outlives it. Cost: O(posts).
  explicit Prominences(const Terrain& terrain);

  /// At least so much: the greatest difference, in quanta, between the edge's height and that of the
  /// highest other edge of the terrain, over the middle lines of the widest of its patches. A lower bound
  /// of the greatest over all its lines of sight; nearly exact for each line (doubles). Never negative:
  /// 0 where level ground ties.
  /// Cost: O(columns + rows).
  [[nodiscard]] double Of(Edge edge, const Sights& sights) const;

 private:
  const Terrain& terrain_;
  bool has_holes_;
};

}  // namespace farhorizon

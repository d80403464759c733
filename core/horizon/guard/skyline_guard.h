#pragma once

#include <vector>

#include "core/geometry/finer_heights.h"
#include "core/horizon/horizon.h"
#include "core/horizon/visibility/occluder_set.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// Keeps a mesh from rising above the DEM's skyline: finds whether an edge, lowered by an
/// allowance, is occluded by the DEM in every direction (core/simplify/README.md, theorem S4).
///
/// The occluders are the DEM's horizon edges only, because they generate H (core/horizon/README.md,
/// corollary 2a), and virtual occluders across the ground, for speed.
class SkylineGuard {
 public:
  /// Requires: both outlive the guard.
  SkylineGuard(const Terrain& terrain, const Horizon& horizon);

  /// True only if a segment between two posts at any heights, in steps of scale(), is occluded.
  /// False: not known. Cost: the cells that it crosses.
  [[nodiscard]] bool IsSurelyOccluded(const Segment& scaled) const;
  /// Whether such a segment is occluded. Exact.
  /// likely: members of the guard's set that are tried first. Where a search has proven the answer
  /// it leaves there those that occlude the segment: they will occlude most of what is near. The
  /// answer does not depend on it.
  [[nodiscard]] bool IsOccluded(const Segment& scaled, std::vector<OccluderId>& likely) const;

  [[nodiscard]] const FinerHeights& scale() const { return scale_; }

 private:
  const Terrain* terrain_;
  const HullMergeTree* hulls_;
  FinerHeights scale_;
  OccluderSet occluders_;
};

}  // namespace farhorizon

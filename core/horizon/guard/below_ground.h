#pragma once

#include <cstdint>

#include "core/geometry/finer_heights.h"
#include "core/geometry/segment.h"
#include "core/horizon/horizon.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// True only if the segment between two posts, heights in steps of `scale`, is at every point at or
/// below the ground, or inside a merged hull of ground at least as high. Either way it is below the
/// DEM's visual hull, so it is occluded in every direction. False: not known.
///
/// Requires: the segment lies in the terrain's domain. Cost: the cells that it crosses.
bool GroundCovers(const Terrain& terrain, const HullMergeTree& hulls, const FinerHeights& scale,
                  const Segment& scaled);

}  // namespace farhorizon

#pragma once

#include "core/horizon/horizon.h"
#include "core/terrain/dem.h"
#include "core/terrain/mesh.h"

namespace farhorizon {

/// True only if ground that is `less_m` below the DEM's horizon edges at most is at least as high,
/// on every line that crosses the segment, as the segment. False: not known.
bool IsInHull(const Dem& dem, const HullMergeTree& hulls, const GridPoint& a, const GridPoint& b,
              double less_m);

}  // namespace farhorizon

#pragma once

#include <functional>
#include <vector>

#include "core/horizon/visibility/occluder_set.h"
#include "core/terrain/dem.h"

namespace farhorizon {

/// The smallest DEM to be had from `dem` by dropping rows and columns, taking posts out and
/// lowering heights, such that `fails` still holds. Requires: fails(dem).
/// Cost: some thousand calls of `fails` for 7 x 7 posts.
Dem Shrink(Dem dem, const std::function<bool(const Dem&)>& fails);

/// The smallest set of obstacles to be had by dropping some and lowering heights.
std::vector<Segment> Shrink(std::vector<Segment> segments,
                            const std::function<bool(const std::vector<Segment>&)>& fails);

}  // namespace farhorizon

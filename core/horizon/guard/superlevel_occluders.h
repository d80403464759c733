#pragma once

#include <vector>

#include "core/horizon/visibility/occluder_set.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// Long horizontal segments that are virtual occluders: each joins two posts of one connected
/// component of a superlevel set, at its height, so every line across it meets ground at least as
/// high. Taken at up to 64 heights.
///
/// They do not change what a set of occluders that includes the terrain's horizon edges occludes
/// (core/horizon/README.md, corollary 2a), but each stands for a whole hill, so queries end sooner.
/// heights: the heights at which the occluders are taken are quantiles of these. Pass the heights
/// of the segments that will be queried.
/// Cost: O(n log n), and the components at each height.
std::vector<Segment> SuperlevelOccluders(const Terrain& terrain, std::vector<std::int32_t> heights);

}  // namespace farhorizon

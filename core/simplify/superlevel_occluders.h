#pragma once

#include <vector>

#include "core/horizon/visibility/occluder_set.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// Long level segments that no line of sight crosses without meeting ground at or above them: chords
/// across the connected pieces of the ground at or above a level, for some sixty levels.
///
/// They add nothing to a skyline that they are put into, but hide much at once, so that questions are
/// decided sooner. levels are drawn from `heights`, of which most should be near what will be asked.
/// Cost: O(n log n), and the pieces at each level.
std::vector<Segment> SuperlevelOccluders(const Terrain& terrain, std::vector<std::int32_t> heights);

}  // namespace farhorizon

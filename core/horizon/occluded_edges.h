#pragma once

#include <cstdint>
#include <vector>

#include "core/terrain/mesh.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// The number of `edges` that are not on the horizon (core/horizon/README.md, definition D2), or no
/// edges of the terrain: each is decided over all edges of the terrain, without a sweep, candidates
/// or virtual occluders. Exact.
/// Cost: O(terrain's edges), and for each of `edges` about those that are visible from it.
std::int64_t CountOccluded(const Terrain& terrain, const std::vector<Edge>& edges);

}  // namespace farhorizon

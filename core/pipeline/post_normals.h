#pragma once

#include <vector>

#include "core/base/result.h"
#include "core/io/draco_mesh.h"
#include "core/pipeline/placement.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// The terrain's own smooth normal at each of `posts`, in the local frame: the mean of the faces around
/// the post, each by its area. It is the DEM's whatever mesh it is put on, so that a coarse level
/// keeps the shades of the relief that it has lost.
///
/// A normal that leans lower than kLeastNormalUp is raised to there.
/// Requires: posts are vertices of the terrain; in any order, repeated or not.
/// Errors: those of placing posts. Cost: O(n), up to seven posts placed for each.
Result<std::vector<UnitNormal>> PostNormals(const Terrain& terrain, const Placement& placement,
                                            const std::vector<VertexId>& posts);

}  // namespace farhorizon

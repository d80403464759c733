#pragma once

#include <vector>

#include "core/base/result.h"
#include "core/terrain/dem.h"
#include "core/terrain/mesh.h"

namespace farhorizon {

/// Makes most of a mesh's area counter-clockwise (Triangle): turns all triangles round where more
/// of it is clockwise. Whether it did.
bool TurnCounterClockwise(GridMesh& mesh);

/// Drops walls: triangles that stand upright, as skirts do. Those over which ground may be hidden
/// from afar, because they rise above what they hang on, stay.
///
/// cell_m: a cell on the ground, metres. How many were dropped.
std::int64_t DropSkirts(GridMesh& mesh, double cell_m);

/// The height of a mesh at each post of a DEM, metres; NaN where the mesh does not cover it.
/// Errors: kUnsupportedData, kind "overlap", where triangles cover the DEM more than 64 times, or
///   have 4e9 rows of it in all: work would have no bound.
/// Cost: O(posts + triangles) for meshes that cover the plan once.
Result<std::vector<double>> HeightsOverPosts(const GridMesh& mesh, const Dem& dem);

}  // namespace farhorizon

#pragma once

#include <vector>

#include "core/base/result.h"
#include "core/terrain/mesh.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// Whether a level covers its DEM: every vertex is within half a cell of its post, no triangle is
/// flipped, nothing overlaps, there is no hole and no T-junction, and the mesh ends where the
/// terrain ends. posts: of each point of the mesh.
/// Errors: kUnsupportedData with the first fault: kinds "unnamed-points", "unknown-post",
///   "displaced-vertex", "unknown-point", "flipped-triangle", "overlap", "hole".
Status CheckCovers(const Terrain& terrain, const GridMesh& mesh,
                   const std::vector<VertexId>& posts);

}  // namespace farhorizon

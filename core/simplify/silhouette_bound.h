#pragma once

#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/horizon/horizon.h"
#include "core/simplify/mesh_edges.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// A bound on |H_dem - H_mesh| for a mesh over posts, quanta: at most about a twentieth above the
/// least one, or a step of FinerHeights where that is more.
///
/// Proven edge by edge: no ridge of the mesh, lowered by it, is in sight over the DEM's horizon edges,
/// and no horizon edge, lowered by it, is in sight over the mesh. 0 says that the silhouettes are equal.
/// asked: where the search begins that follows an edge which 0 is not enough for, quanta.
/// Requires: the mesh covers the terrain's domain, no triangle flipped.
/// Errors: kCancelled. Cost: a sight for each edge that simpler proofs leave open.
Result<double> SilhouetteBound(const Terrain& terrain, const Horizon& horizon,
                               const std::vector<MeshEdge>& edges, double asked,
                               const Watch& watch);

/// Whether `e` may carry the skyline of its mesh: a ridge between its faces, or at the rim.
bool MayCarrySkyline(const Terrain& terrain, const MeshEdge& e);

}  // namespace farhorizon

#pragma once

#include <vector>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/horizon/horizon.h"
#include "core/measure/mesh_edges.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// A bound on |H_dem - H_mesh| for a mesh over posts, quanta: at most about a twentieth above the
/// least one, or a step of FinerHeights where that is more.
///
/// Proven edge by edge: every ridge of the mesh, lowered by the bound, is occluded by the DEM's
/// horizon edges, and every horizon edge, lowered by the bound, is occluded by the mesh
/// (core/simplify/README.md, theorem S4). 0 means that the silhouettes are equal.
/// asked: the value that is tried first for an edge that needs more than 0, quanta. The bound does
/// not exceed it if it can be proven.
/// Requires: the mesh covers the terrain's domain, no triangle flipped.
/// Errors: kCancelled. Cost: a visibility query for each edge that simpler proofs do not settle.
Result<double> SilhouetteBound(const Terrain& terrain, const Horizon& horizon,
                               const std::vector<MeshEdge>& edges, double asked,
                               const RunControl& control);

}  // namespace farhorizon

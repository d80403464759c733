#pragma once

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/horizon/horizon.h"
#include "core/terrain/mesh.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// Greatest and root mean square of an error, metres.
struct ErrorMeasure {
  double max_m = 0;
  double rms_m = 0;
};

/// How far a mesh is from its DEM, in the frame of the grid.
struct MeshError {
  ErrorMeasure vertical;    ///< |height of the DEM - height of the mesh| at the posts
  ErrorMeasure silhouette;  ///< max: a proven upper bound; rms: over a sample of lines
  double displacement = 0;  ///< greatest distance of a vertex from its post, columns or rows
};

/// Measures `mesh`, whose point i stands for post `posts[i]`, against the terrain.
///
/// silhouette.max_m is the sum of two bounds. The first is for the mesh over the posts, proven
/// exactly (SilhouetteBound) and at most about a twentieth above the least that can be proven. The
/// second is for the distance of the vertices from their posts. Lines that pass the outline closer
/// than that distance may meet one of the two surfaces only; the bound does not hold for them.
/// asked_m: the silhouette error that was asked for. The search starts at it; if it can be proven,
/// the result does not exceed it. silhouette.rms_m is over a sample of lines that is uniform in the
/// plan where a column is as wide as a row (RmsOverLines).
/// Errors: kUnsupportedData where the mesh has a hole, a flipped triangle or a vertex away from its
///   post by more than half a cell; kCancelled.
Result<MeshError> MeasureMeshError(const Terrain& terrain, const Horizon& horizon,
                                   const GridMesh& mesh, const std::vector<VertexId>& posts,
                                   double asked_m, const RunControl& control);

}  // namespace farhorizon

#pragma once

#include "core/base/progress.h"
#include "core/base/result.h"
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
  ErrorMeasure silhouette;  ///< max: an upper bound, certified; rms: over lines drawn uniformly
  double displacement = 0;  ///< greatest distance of a vertex from its post, columns or rows
};

/// Measures `mesh`, whose point i stands for post `posts[i]`, against the terrain.
///
/// The silhouette bound is a proof: no edge of the mesh lowered by it is in sight over the terrain,
/// no horizon edge lowered by it is in sight over the mesh (exact, on the posts), plus what the
/// vertices' distance from their posts can do. Lines that pass the outline closer than that distance,
/// and so may meet one of the two surfaces only, are not counted. The bound is at most about a
/// twentieth above the least that can be proven on the posts; `asked_m` is where the search for it
/// begins; where that can be proven, the bound is no more. The rms is over lines drawn uniformly in the plan where a column is as wide as a row.
/// Errors: kUnsupportedData where the mesh has a hole, a flipped triangle or a vertex away from its
///   post by more than half a cell; kCancelled.
Result<MeshError> MeasureMeshError(const Terrain& terrain, const Horizon& horizon,
                                   const GridMesh& mesh, const std::vector<VertexId>& posts,
                                   double asked_m, const Watch& watch);

}  // namespace farhorizon

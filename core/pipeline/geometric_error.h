#pragma once

#include <vector>

#include "core/base/result.h"
#include "core/io/local_mesh.h"
#include "core/pipeline/georeference.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// The greatest distance in space, metres, between a post of the DEM and the point of the mesh over
/// the same point of the plan. Unlike the vertical error it includes what flat triangles cut off
/// the curved earth.
///
/// mesh: as decoded. Requires: mesh.posts are posts of the terrain; triangles cover all of them.
/// Errors: those of Georeference::ToGeodetic and ToEnu. Cost: O(posts); a row of posts at a time in
///   memory.
Result<double> MeasureGeometricError(const Terrain& terrain, const Georeference& georeference,
                                     const LocalMesh& mesh);

}  // namespace farhorizon

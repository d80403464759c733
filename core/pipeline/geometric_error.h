#pragma once

#include <vector>

#include "core/base/result.h"
#include "core/io/draco_mesh.h"
#include "core/pipeline/georeference.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// How far the decoded mesh is from the DEM in space, metres: for each post, the distance to the point of
/// the mesh that stands for the same place of the plan; the greatest of them. It has in it what the
/// vertical error does not: that a flat triangle cuts through the curved earth.
///
/// mesh: as decoded, sources naming its vertices' posts.
/// Errors: those of placing posts. Cost: O(posts); a row of posts at a time in memory.
Result<double> MeasureGeometricError(const Terrain& terrain, const Georeference& georeference,
                                     const LocalMesh& mesh);

}  // namespace farhorizon

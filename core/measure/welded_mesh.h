#pragma once

#include "core/base/result.h"
#include "core/measure/mesh_error.h"

namespace farhorizon {

/// The mesh with points that are one and the same taken as one, and without triangles that have
/// fewer than three points then: files repeat a point for each triangle, or where normals differ.
///
/// Errors: kUnsupportedData, kind "unknown-point" where a triangle names a point that the mesh does
///   not have, "bad-mesh" where a point is not finite, or `straight` has not one for each.
Result<PlacedMesh> WeldedMesh(const PlacedMesh& mesh);

}  // namespace farhorizon

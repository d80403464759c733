#pragma once

#include <string_view>

#include "core/io/mesh_files/file_mesh.h"

namespace farhorizon {

/// Reads Wavefront OBJ: `v` and `f`; polygons become fans. Everything else is passed over; no file
/// that it names (mtllib) is opened.
/// Errors: "bad-mesh-file" with the line; "mesh-too-large".
Result<FileMesh> ReadObj(std::string_view text, const MeshLimits& limits);

}  // namespace farhorizon

#pragma once

#include <string_view>

#include "core/io/mesh_files/file_mesh.h"

namespace farhorizon {

/// Reads PLY, as text or binary in either byte order: x, y, z of `vertex`, and the list
/// `vertex_indices` or `vertex_index` of `face`; polygons become fans. Other elements and
/// properties are passed over.
/// Errors: "bad-mesh-file"; "mesh-too-large".
Result<FileMesh> ReadPly(std::string_view bytes, const MeshLimits& limits);

}  // namespace farhorizon

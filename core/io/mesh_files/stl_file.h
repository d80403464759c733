#pragma once

#include <string_view>

#include "core/io/mesh_files/file_mesh.h"

namespace farhorizon {

/// Reads STL, as text or as bytes. Each triangle has its own three points (TidyMesh joins them).
/// Errors: "bad-mesh-file"; "mesh-too-large".
Result<FileMesh> ReadStl(std::string_view bytes, const MeshLimits& limits);

}  // namespace farhorizon

#pragma once

#include "core/io/mesh_files/gltf_buffers.h"
#include "core/io/mesh_files/gltf_json.h"

namespace farhorizon {

inline constexpr char kGltfDraco[] = "KHR_draco_mesh_compression";

/// Whether a primitive is of triangles, as a list, a strip or a fan, and not of points or lines.
/// Both throw nlohmann::json::exception where the JSON is not as glTF has it.
bool HasTriangles(const MeshJson& primitive);

/// The triangles of a primitive, before its node places them. Indices are not checked.
/// Requires: HasTriangles. Errors: those of GltfBuffers and ReadDracoMesh.
Result<FileMesh> ReadPrimitive(const MeshJson& primitive, GltfBuffers& buffers,
                               const MeshLimits& limits);

}  // namespace farhorizon

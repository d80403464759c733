#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "core/io/mesh_files/file_mesh.h"

namespace farhorizon {

/// Reads the triangles of a glTF 2.0, binary or text: all primitives of the default scene, placed
/// by their nodes' matrices, in glTF's axes (FileFrame::kYUp). Positions may be under
/// KHR_draco_mesh_compression, EXT_meshopt_compression and KHR_mesh_quantization; points and lines
/// are passed over.
///
/// folder: where buffers in files of their own lie; nothing outside it is opened.
/// Errors: "bad-glb" and "bad-mesh-file", with the cause, also for an extension that is required
///   and unknown, and for nodes that are no trees; "mesh-too-large"; kNotFound for a buffer's file.
Result<FileMesh> ReadGltf(std::span<const std::uint8_t> bytes, const std::filesystem::path& folder,
                          const MeshLimits& limits);

}  // namespace farhorizon

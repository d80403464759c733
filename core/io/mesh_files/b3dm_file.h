#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "core/io/mesh_files/file_mesh.h"

namespace farhorizon {

/// Reads the glTF in a batched 3D model of 3D Tiles 1.0, with its RTC_CENTER, as ReadGltf.
Result<FileMesh> ReadB3dm(std::span<const std::uint8_t> bytes, const std::filesystem::path& folder,
                          const MeshLimits& limits);

}  // namespace farhorizon

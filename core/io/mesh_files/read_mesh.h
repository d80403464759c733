#pragma once

#include <filesystem>

#include "core/io/mesh_files/file_mesh.h"

namespace farhorizon {

enum class MeshFormat { kGltf, kB3dm, kDraco, kObj, kPly, kStl, kTileset };

/// The format of a mesh file: by its first bytes, or where they do not tell, by its ending.
/// Errors: kNotFound, kIo; kUnsupportedData, kind "bad-mesh-file", where neither tells a format.
Result<MeshFormat> MeshFormatOf(const std::filesystem::path& file);

/// Reads a file that holds one mesh, tidied (TidyMesh).
/// Requires: it is no tileset. Errors: those of its reader, with the file's name in front.
Result<FileMesh> ReadMesh(const std::filesystem::path& file, const MeshLimits& limits);

}  // namespace farhorizon

// The format of a file and the reader that it goes to. First bytes come before the ending of the
// name, which others choose.
#include "core/io/mesh_files/read_mesh.h"

#include <algorithm>
#include <fstream>
#include <string>
#include <utility>

#include "core/base/lower.h"
#include "core/io/file.h"
#include "core/io/mesh_files/b3dm_file.h"
#include "core/io/mesh_files/draco_file.h"
#include "core/io/mesh_files/gltf_file.h"
#include "core/io/mesh_files/obj_file.h"
#include "core/io/mesh_files/ply_file.h"
#include "core/io/mesh_files/stl_file.h"

namespace farhorizon {

namespace {

std::span<const std::uint8_t> BytesOf(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

Result<FileMesh> ReadAs(MeshFormat format, const std::string& bytes,
                        const std::filesystem::path& folder, const MeshLimits& limits) {
  switch (format) {
    case MeshFormat::kGltf:
      return ReadGltf(BytesOf(bytes), folder, limits);
    case MeshFormat::kB3dm:
      return ReadB3dm(BytesOf(bytes), folder, limits);
    case MeshFormat::kDraco:
      return ReadDracoMesh(BytesOf(bytes), std::nullopt, limits);
    case MeshFormat::kObj:
      return ReadObj(bytes, limits);
    case MeshFormat::kPly:
      return ReadPly(bytes, limits);
    case MeshFormat::kStl:
      return ReadStl(bytes, limits);
    case MeshFormat::kTileset:
      break;
  }
  throw InternalError("a tileset holds no mesh itself");
}

}  // namespace

Result<MeshFormat> MeshFormatOf(const std::filesystem::path& file) {
  std::error_code failure;
  if (!std::filesystem::is_regular_file(file, failure)) {
    const bool there = std::filesystem::exists(file, failure);
    return Error{
        there ? ErrorCode::kIo : ErrorCode::kNotFound,
        "\"" + file.filename().string() + "\" is " + (there ? "no regular file" : "not there"),
        there ? ErrorKind("io") : ErrorKind("no-such-file")};
  }
  std::ifstream in(file, std::ios::binary);
  std::string beginning(5, '\0');
  in.read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
  beginning.resize(static_cast<std::size_t>(in.gcount()));
  if (beginning.starts_with("glTF")) return MeshFormat::kGltf;
  if (beginning.starts_with("b3dm")) return MeshFormat::kB3dm;
  if (beginning.starts_with("DRACO")) return MeshFormat::kDraco;
  if (beginning.starts_with("ply")) return MeshFormat::kPly;
  const std::string ending = Lower(file.extension().string());
  if (ending == ".gltf") return MeshFormat::kGltf;
  if (ending == ".json") return MeshFormat::kTileset;
  if (ending == ".obj") return MeshFormat::kObj;
  if (ending == ".stl") return MeshFormat::kStl;
  return BadMeshFile("\"" + file.filename().string() +
                     "\" is no mesh that is read: GLB, glTF, Draco (.drc), OBJ, PLY, STL, or the "
                     "tileset.json of 3D Tiles");
}

Result<FileMesh> ReadMesh(const std::filesystem::path& file, const MeshLimits& limits) {
  Result<MeshFormat> format = MeshFormatOf(file);
  if (!format) return std::move(format.error());
  Result<std::string> bytes = ReadFile(file, limits.max_bytes);
  if (!bytes) return std::move(bytes.error());
  Result<FileMesh> mesh = ReadAs(*format, *bytes, file.parent_path(), limits);
  if (!mesh) return std::move(mesh.error()).WithContext(file.filename().string());
  if (Status tidy = TidyMesh(*mesh); !tidy) {
    return std::move(tidy.error()).WithContext(file.filename().string());
  }
  return mesh;
}

}  // namespace farhorizon

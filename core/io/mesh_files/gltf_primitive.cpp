#include "core/io/mesh_files/gltf_primitive.h"

#include <utility>

#include "core/io/gltf_numbers.h"
#include "core/io/mesh_files/draco_file.h"

namespace farhorizon {

namespace {

constexpr std::uint64_t kStrip = 5;
constexpr std::uint64_t kFan = 6;

// The triangles of indices in a mode of glTF.
void AddTriangles(const std::vector<std::uint32_t>& indices, std::uint64_t mode, FileMesh& mesh) {
  if (mode == gltf::kTriangles) {
    for (std::size_t i = 2; i < indices.size(); i += 3) {
      mesh.triangles.push_back({indices[i - 2], indices[i - 1], indices[i]});
    }
    return;
  }
  for (std::size_t i = 2; i < indices.size(); ++i) {
    if (mode == kFan) {
      mesh.triangles.push_back({indices[0], indices[i - 1], indices[i]});
    } else {
      const bool odd = i % 2 == 1;
      mesh.triangles.push_back(
          {indices[odd ? i - 1 : i - 2], indices[odd ? i - 2 : i - 1], indices[i]});
    }
  }
}

}  // namespace

bool HasTriangles(const MeshJson& primitive) {
  const std::uint64_t mode = CountOr(primitive, "mode", gltf::kTriangles);
  return mode == gltf::kTriangles || mode == kStrip || mode == kFan;
}

Result<FileMesh> ReadPrimitive(const MeshJson& primitive, GltfBuffers& buffers,
                               const MeshLimits& limits) {
  const std::uint64_t mode = CountOr(primitive, "mode", gltf::kTriangles);
  const MeshJson* extensions = Member(primitive, "extensions");
  if (const MeshJson* draco = extensions == nullptr ? nullptr : Member(*extensions, kGltfDraco)) {
    Result<GltfBuffers::View> view = buffers.ViewOf(CountIn(draco->at("bufferView")));
    if (!view) return std::move(view.error());
    Result<FileMesh> decoded = ReadDracoMesh(
        view->bytes, static_cast<std::uint32_t>(CountIn(draco->at("attributes").at("POSITION"))),
        limits);
    return decoded;
  }
  FileMesh part;
  const MeshJson* position = Member(primitive.at("attributes"), "POSITION");
  if (position == nullptr) return part;
  Result<std::vector<FilePoint>> points = buffers.Points(CountIn(*position));
  if (!points) return std::move(points.error());
  part.points = *std::move(points);
  if (const MeshJson* accessor = Member(primitive, "indices")) {
    Result<std::vector<std::uint32_t>> indices = buffers.Indices(CountIn(*accessor));
    if (!indices) return std::move(indices.error());
    AddTriangles(*indices, mode, part);
    return part;
  }
  std::vector<std::uint32_t> indices(part.points.size());
  for (std::uint32_t i = 0; i < indices.size(); ++i) indices[i] = i;
  AddTriangles(indices, mode, part);
  return part;
}

}  // namespace farhorizon

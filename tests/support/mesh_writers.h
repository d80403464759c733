#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace farhorizon {

/// Writers of mesh files that share nothing with the readers. Texts and bytes as files have them.
struct PlainMesh {
  std::vector<std::array<double, 3>> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// columns x rows points at whole numbers, height(column, row) up, the row as y; two triangles a
/// cell, counter-clockwise seen from above (z), cut as the terrain's cells are where y runs down.
template <typename Height>
PlainMesh GridMeshOf(std::uint32_t columns, std::uint32_t rows, Height height) {
  PlainMesh mesh;
  for (std::uint32_t r = 0; r < rows; ++r) {
    for (std::uint32_t c = 0; c < columns; ++c) {
      mesh.points.push_back({double(c), double(r), double(height(c, r))});
    }
  }
  const auto id = [columns](std::uint32_t c, std::uint32_t r) { return r * columns + c; };
  for (std::uint32_t r = 0; r + 1 < rows; ++r) {
    for (std::uint32_t c = 0; c + 1 < columns; ++c) {
      mesh.triangles.push_back({id(c, r), id(c + 1, r + 1), id(c, r + 1)});
      mesh.triangles.push_back({id(c, r), id(c + 1, r), id(c + 1, r + 1)});
    }
  }
  return mesh;
}

std::string ObjText(const PlainMesh& mesh);
std::string PlyText(const PlainMesh& mesh);
/// Points in doubles, faces as lists with a byte for their length.
std::string PlyBytes(const PlainMesh& mesh, bool big_endian);
std::string StlText(const PlainMesh& mesh);
std::string StlBytes(const PlainMesh& mesh);
/// Without quantisation.
std::string DracoText(const PlainMesh& mesh, bool edgebreaker);

/// A glTF and the bytes of its one buffer.
struct TestGltf {
  nlohmann::json json;
  std::string buffer;
};
/// One node with one primitive; positions as floats, indices in four bytes.
TestGltf PlainGltf(const PlainMesh& mesh);
/// The same under KHR_draco_mesh_compression.
TestGltf DracoGltf(const PlainMesh& mesh);
/// The same as whole numbers of 16 bits under EXT_meshopt_compression. Requires: points are such.
TestGltf MeshoptGltf(const PlainMesh& mesh);

std::string GlbBytes(const TestGltf& gltf);
/// With its buffer in a data: address.
std::string EmbeddedText(const TestGltf& gltf);

}  // namespace farhorizon

// A triangle's part follows from the least column and row of its corners, as no triangle crosses a
// line. Parts have vertices of their own; joined again, those that are alike become one.
#include "core/pipeline/level_parts.h"

#include <algorithm>
#include <array>
#include <limits>
#include <tuple>
#include <utility>

namespace farhorizon {

namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

// The place of the part that has the triangle: its box lies within one.
PartPlace PlaceOf(const std::array<std::uint32_t, 3>& triangle, const LocalMesh& mesh,
                  const Dem& dem, const PartGrid& grid) {
  std::int32_t column = dem.columns;
  std::int32_t row = dem.rows;
  for (const std::uint32_t v : triangle) {
    const auto post = static_cast<VertexId>(mesh.posts[v]);
    column = std::min(column, dem.Column(post));
    row = std::min(row, dem.Row(post));
  }
  return {grid.ColumnPart(column), grid.RowPart(row)};
}

// Adds triangles of a mesh to a part, with the vertices that they need.
class PartBuilder {
 public:
  explicit PartBuilder(const LocalMesh& mesh) : mesh_(mesh), index_(mesh.positions.size(), kNone) {}

  LocalMesh Of(const std::vector<std::uint32_t>& triangles) {
    LocalMesh part;
    std::vector<std::uint32_t> taken;
    for (const std::uint32_t t : triangles) {
      std::array<std::uint32_t, 3>& corners = part.triangles.emplace_back(mesh_.triangles[t]);
      for (std::uint32_t& v : corners) v = Take(v, part, taken);
    }
    for (const std::uint32_t v : taken) index_[v] = kNone;
    return part;
  }

 private:
  std::uint32_t Take(std::uint32_t v, LocalMesh& part, std::vector<std::uint32_t>& taken) {
    if (index_[v] != kNone) return index_[v];
    index_[v] = static_cast<std::uint32_t>(taken.size());
    taken.push_back(v);
    part.positions.push_back(mesh_.positions[v]);
    part.posts.push_back(mesh_.posts[v]);
    part.normals.push_back(mesh_.normals[v]);
    return index_[v];
  }

  const LocalMesh& mesh_;
  std::vector<std::uint32_t> index_;  // per vertex of the mesh: in the part, kNone outside
};

}  // namespace

std::string PartGlbName(int level, const PartDepth& depth, const PartPlace& place) {
  std::string name = "lod" + std::to_string(level);
  if (depth != PartDepth{}) {
    name += "-" + std::to_string(place.column) + "-" + std::to_string(place.row);
  }
  return name + ".glb";
}

std::vector<MeshPart> CutIntoParts(const LocalMesh& mesh, const Dem& dem, const PartDepth& depth) {
  const PartGrid grid(dem.columns, dem.rows, depth);
  std::vector<std::vector<std::uint32_t>> triangles(static_cast<std::size_t>(depth.Parts()));
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const PartPlace place = PlaceOf(mesh.triangles[t], mesh, dem, grid);
    triangles[static_cast<std::size_t>((place.row << depth.columns) + place.column)].push_back(t);
  }
  std::vector<MeshPart> parts;
  PartBuilder builder(mesh);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (triangles[i].empty()) continue;
    const auto at = static_cast<std::int32_t>(i);
    const PartPlace place = {at & ((1 << depth.columns) - 1), at >> depth.columns};
    parts.push_back({place, builder.Of(triangles[i])});
  }
  return parts;
}

LocalMesh JoinMeshes(const std::vector<LocalMesh>& meshes) {
  const auto key = [&meshes](const std::pair<std::uint32_t, std::uint32_t>& at) {
    const LocalMesh& mesh = meshes[at.first];
    const Enu& p = mesh.positions[at.second];
    return std::tuple(mesh.posts[at.second], p.east, p.north, p.up, mesh.normals[at.second]);
  };
  std::vector<std::pair<std::uint32_t, std::uint32_t>> vertices;  // (mesh, vertex)
  std::vector<std::vector<std::uint32_t>> index(meshes.size());
  for (std::uint32_t m = 0; m < meshes.size(); ++m) {
    index[m].resize(meshes[m].positions.size());
    for (std::uint32_t v = 0; v < index[m].size(); ++v) vertices.emplace_back(m, v);
  }
  std::ranges::sort(vertices, [&key](const auto& a, const auto& b) { return key(a) < key(b); });
  LocalMesh joined;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const auto& [m, v] = vertices[i];
    if (i == 0 || key(vertices[i]) != key(vertices[i - 1])) {
      joined.positions.push_back(meshes[m].positions[v]);
      joined.posts.push_back(meshes[m].posts[v]);
      joined.normals.push_back(meshes[m].normals[v]);
    }
    index[m][v] = static_cast<std::uint32_t>(joined.positions.size() - 1);
  }
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    for (const auto& [a, b, c] : meshes[m].triangles) {
      joined.triangles.push_back({index[m][a], index[m][b], index[m][c]});
    }
  }
  return joined;
}

}  // namespace farhorizon

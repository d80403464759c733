// What all readers do once they have points and faces: check what triangles name, and tidy the mesh
// before anything measures it.
#include "core/io/mesh_files/file_mesh.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace farhorizon {

namespace {

Status CheckTriangles(const FileMesh& mesh) {
  if (mesh.triangles.empty()) return BadMeshFile("the mesh has no triangle");
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::uint32_t greatest = std::max({a, b, c});
    if (greatest >= mesh.points.size()) {
      return BadMeshFile("a triangle names point " + std::to_string(greatest) + " of " +
                         std::to_string(mesh.points.size()) + ", counted from 0");
    }
    for (const std::uint32_t v : {a, b, c}) {
      const FilePoint& p = mesh.points[v];
      if (!std::ranges::all_of(p, [](double x) { return std::isfinite(x); })) {
        return BadMeshFile("point " + std::to_string(v) +
                           ", counted from 0, has a coordinate that is no finite number");
      }
    }
  }
  return Ok{};
}

}  // namespace

std::string Printable(std::string text) {
  constexpr char kDelete = 0x7f;
  std::ranges::replace_if(
      text, [](char c) { return static_cast<unsigned char>(c) < ' ' || c == kDelete; }, '?');
  return text;
}

Error BadMeshFile(const std::string& message) {
  return {ErrorCode::kUnsupportedData, Printable(message), "bad-mesh-file"};
}

Status CheckCounts(std::uint64_t points, std::uint64_t triangles, const MeshLimits& limits) {
  const auto too_many = [](std::uint64_t count, const char* what, std::size_t most) {
    return Error{ErrorCode::kResourceExhausted,
                 "the mesh has " + std::to_string(count) + " " + what + "; at most " +
                     std::to_string(most) + " are read",
                 "mesh-too-large"};
  };
  if (points > limits.max_points) return too_many(points, "points", limits.max_points);
  if (triangles > limits.max_triangles) {
    return too_many(triangles, "triangles", limits.max_triangles);
  }
  return Ok{};
}

void AddPolygon(const std::vector<std::uint32_t>& corners, FileMesh& mesh) {
  for (std::size_t i = 2; i < corners.size(); ++i) {
    mesh.triangles.push_back({corners[0], corners[i - 1], corners[i]});
  }
  if (corners.size() > 3) ++mesh.polygons;
}

Status TidyMesh(FileMesh& mesh) {
  if (Status sound = CheckTriangles(mesh); !sound) return sound;
  std::vector<bool> used(mesh.points.size(), false);
  for (const auto& t : mesh.triangles) {
    for (const std::uint32_t v : t) used[v] = true;
  }
  for (FilePoint& p : mesh.points) {
    for (double& x : p) x += 0.0;  // -0 is 0
  }
  // Points in use, equal ones side by side, the first of the file first.
  std::vector<std::uint32_t> order;
  for (std::uint32_t v = 0; v < mesh.points.size(); ++v) {
    if (used[v]) order.push_back(v);
  }
  std::ranges::sort(order, [&](std::uint32_t p, std::uint32_t q) {
    return mesh.points[p] != mesh.points[q] ? mesh.points[p] < mesh.points[q] : p < q;
  });
  std::vector<std::uint32_t> first(mesh.points.size());
  std::iota(first.begin(), first.end(), 0U);
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (mesh.points[order[i]] == mesh.points[order[i - 1]]) first[order[i]] = first[order[i - 1]];
  }
  std::vector<std::uint32_t> number(mesh.points.size());
  std::vector<FilePoint> kept;
  for (std::uint32_t v = 0; v < mesh.points.size(); ++v) {
    if (!used[v] || first[v] != v) continue;
    number[v] = static_cast<std::uint32_t>(kept.size());
    kept.push_back(mesh.points[v]);
  }
  mesh.points = std::move(kept);
  for (auto& t : mesh.triangles) {
    for (std::uint32_t& v : t) v = number[first[v]];
  }
  std::erase_if(mesh.triangles,
                [](const auto& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
  if (mesh.triangles.empty()) {
    return BadMeshFile("each triangle of the mesh has two corners at one point");
  }
  return Ok{};
}

}  // namespace farhorizon

#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/simplify/mesh/half_edge_mesh.h"

namespace farhorizon {

/// Twice the area of a terrain's domain in plan.
inline std::int64_t TwiceAreaOf(const Terrain& terrain) {
  return std::ssize(terrain.Triangles());  // each is half of a cell
}

/// The origins of a triangle, from the least on.
using Corners = std::array<std::int32_t, 3>;

inline Corners Turned(Corners t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

inline std::set<Corners> TrianglesOf(const HalfEdgeMesh& mesh) {
  std::set<Corners> triangles;
  for (std::int32_t h = 0; h < mesh.half_edges(); h += 3) {
    if (!mesh.Stands(h / 3)) continue;
    triangles.insert(Turned({mesh.origin(h), mesh.origin(h + 1), mesh.origin(h + 2)}));
  }
  return triangles;
}

/// What is wrong with a mesh, found from origins and places alone; empty where nothing is. Covers
/// all invariants that half_edge_mesh.h states.
inline std::string FaultOfMesh(const HalfEdgeMesh& mesh) {
  const auto at = [](std::int32_t id) { return " at " + std::to_string(id); };
  std::set<std::pair<std::int32_t, std::int32_t>> sides;
  std::vector<std::set<std::int32_t>> neighbours(static_cast<std::size_t>(mesh.vertices()));
  std::int64_t area = 0;
  std::int32_t triangles = 0;
  for (std::int32_t t = 0; t < mesh.half_edges() / 3; ++t) {
    if (!mesh.Stands(t)) continue;
    ++triangles;
    const std::int64_t turn = Turn(mesh.at(mesh.origin(3 * t)), mesh.at(mesh.origin(3 * t + 1)),
                                   mesh.at(mesh.origin(3 * t + 2)));
    if (turn <= 0) return "a triangle is flipped or flat" + at(t);
    area += turn;
    for (std::int32_t h = 3 * t; h < 3 * t + 3; ++h) {
      const std::int32_t a = mesh.origin(h);
      const std::int32_t b = mesh.origin(HalfEdgeMesh::Next(h));
      if (!sides.insert({a, b}).second) return "a side stands twice" + at(h);
      neighbours[static_cast<std::size_t>(a)].insert(b);
      neighbours[static_cast<std::size_t>(b)].insert(a);
    }
  }
  if (triangles != mesh.triangles()) return "triangles are miscounted";
  if (area != TwiceAreaOf(mesh.ground().terrain())) return "the areas differ";
  for (std::int32_t h = 0; h < mesh.half_edges(); ++h) {
    if (!mesh.Stands(h / 3)) continue;
    const std::int32_t a = mesh.origin(h);
    const std::int32_t b = mesh.origin(HalfEdgeMesh::Next(h));
    const std::int32_t twin = mesh.twin(h);
    if (twin == HalfEdgeMesh::kNone) {
      if (sides.count({b, a}) > 0) return "a side has no twin" + at(h);
      continue;
    }
    if (mesh.twin(twin) != h) return "a twin's twin is another" + at(h);
    if (!mesh.Stands(twin / 3)) return "a twin is gone" + at(h);
    if (mesh.origin(twin) != b || mesh.origin(HalfEdgeMesh::Next(twin)) != a) {
      return "a twin is another side" + at(h);
    }
  }
  for (std::int32_t v = 0; v < mesh.vertices(); ++v) {
    const std::set<std::int32_t>& around = neighbours[static_cast<std::size_t>(v)];
    if (mesh.IsVertex(v) != !around.empty()) return "a vertex is lost or left over" + at(v);
    if (around.empty()) continue;
    // Fans: as many as sides without a twin begin here; 0 all around.
    int fans = 0;
    for (const std::int32_t w : around) {
      if (sides.count({v, w}) > 0 && sides.count({w, v}) == 0) ++fans;
    }
    if (mesh.IsKnotted(v) != (fans > 1))
      return "a knot is not marked, or another vertex is" + at(v);
    if (fans > 1) continue;
    if (mesh.OnRim(v) != (fans == 1)) return "a ring begins inside a fan" + at(v);
    if (mesh.degree(v) != static_cast<std::int32_t>(around.size())) {
      return "neighbours are miscounted" + at(v);
    }
    Ring ring;
    if (!mesh.Gather(v, ring)) return "a ring cannot be gathered" + at(v);
    if (ring.centre != v || ring.closed != (fans == 0)) return "a ring is another" + at(v);
    std::set<std::int32_t> gathered;
    for (std::int32_t i = 0; i < ring.count; ++i) gathered.insert(ring.id(i));
    if (gathered != around || ring.count != std::ssize(around))
      return "a ring is not whole" + at(v);
    for (std::int32_t i = 0; i < ring.sides(); ++i) {
      const std::int32_t t = ring.triangle_at(i);
      const std::set<std::int32_t> wanted = {v, ring.id(i), ring.id(ring.after(i))};
      const std::set<std::int32_t> found = {mesh.origin(3 * t), mesh.origin(3 * t + 1),
                                            mesh.origin(3 * t + 2)};
      if (found != wanted) return "a ring's triangle is another" + at(v);
    }
  }
  return "";
}

}  // namespace farhorizon

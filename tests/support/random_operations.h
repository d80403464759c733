#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "core/simplify/mesh/half_edge_mesh.h"

namespace farhorizon {

/// Whether the collapse of the ring's centre onto its neighbour at place j keeps the domain and
/// turns no triangle over: the definition, by areas.
inline bool MayCollapse(const HalfEdgeMesh& mesh, const Ring& ring, std::int32_t j) {
  if (ring.count < 3) return false;
  const Place& b = ring.at(j);
  std::int64_t area = 0;
  for (std::int32_t i = 0; i < ring.sides(); ++i) {
    const std::int32_t k = ring.after(i);
    area += Turn(mesh.at(ring.centre), ring.at(i), ring.at(k));
    if (i == j || k == j) continue;
    const std::int64_t turn = Turn(b, ring.at(i), ring.at(k));
    if (turn <= 0) return false;
    area -= turn;
  }
  if (area != 0) return false;
  return ring.closed || j == 0 || j == ring.count - 1;
}

/// Whether the edge of h may be turned to the other diagonal.
inline bool MayFlip(const HalfEdgeMesh& mesh, std::int32_t h) {
  if (!mesh.Stands(h / 3) || mesh.twin(h) == HalfEdgeMesh::kNone) return false;
  const Place& a = mesh.at(mesh.origin(h));
  const Place& c = mesh.at(mesh.origin(HalfEdgeMesh::Next(h)));
  const Place& b = mesh.at(mesh.origin(HalfEdgeMesh::Previous(h)));
  const Place& d = mesh.at(mesh.origin(HalfEdgeMesh::Previous(mesh.twin(h))));
  return Turn(d, c, b) > 0 && Turn(d, b, a) > 0;
}

/// Whether rim vertex v may be cut off: its rim runs straight through it.
inline bool MayCutOff(const HalfEdgeMesh& mesh, std::int32_t v) {
  if (!mesh.IsVertex(v) || mesh.IsKnotted(v) || !mesh.OnRim(v)) return false;
  const std::vector<std::int32_t> spokes = mesh.GatherRim(v);
  return Turn(mesh.at(mesh.origin(HalfEdgeMesh::Next(spokes.front()))), mesh.at(v),
              mesh.at(mesh.origin(HalfEdgeMesh::Previous(spokes.back())))) == 0;
}

/// Tries `count` random collapses and flips and makes those that may be made: a mesh as it is in
/// the middle of simplifying.
inline void Rearrange(HalfEdgeMesh& mesh, int count, std::mt19937& random) {
  Ring ring;
  for (int i = 0; i < count; ++i) {
    if (random() % 2 == 0) {
      const auto v = static_cast<std::int32_t>(random() % static_cast<unsigned>(mesh.vertices()));
      if (!mesh.IsVertex(v) || !mesh.Gather(v, ring)) continue;
      const auto j = static_cast<std::int32_t>(random() % static_cast<unsigned>(ring.count));
      if (!MayCollapse(mesh, ring, j)) continue;
      mesh.Collapse(ring, ring.id(j));
      for (std::int32_t k = 0; k < ring.sides(); ++k) mesh.Measure(ring.triangle_at(k));
    } else {
      const auto h = static_cast<std::int32_t>(random() % static_cast<unsigned>(mesh.half_edges()));
      if (!MayFlip(mesh, h)) continue;
      const std::int32_t other = mesh.twin(h) / 3;
      mesh.Flip(h);
      mesh.Measure(h / 3);
      mesh.Measure(other);
    }
  }
}

}  // namespace farhorizon

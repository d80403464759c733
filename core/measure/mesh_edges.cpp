#include "core/measure/mesh_edges.h"

#include <algorithm>
#include <tuple>

namespace farhorizon {

std::optional<std::vector<MeshEdge>> EdgesOf(const std::vector<Triangle>& triangles) {
  struct HalfEdge {
    Edge edge;
    bool left;  // the triangle is on the left of a -> b
    VertexId third;
  };
  std::vector<HalfEdge> half_edges;
  half_edges.reserve(triangles.size() * 3);
  for (const Triangle& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId from = t[k];
      const VertexId to = t[(k + 1) % 3];
      half_edges.push_back({MakeEdge(from, to), from < to, t[(k + 2) % 3]});
    }
  }
  std::sort(half_edges.begin(), half_edges.end(), [](const HalfEdge& p, const HalfEdge& q) {
    return std::tie(p.edge, p.left, p.third) < std::tie(q.edge, q.left, q.third);
  });
  std::vector<MeshEdge> edges;
  edges.reserve(half_edges.size() / 2);
  for (const HalfEdge& half : half_edges) {
    if (edges.empty() || edges.back().edge != half.edge) edges.push_back({half.edge, {}, {}});
    std::optional<VertexId>& slot = half.left ? edges.back().left : edges.back().right;
    if (slot) return std::nullopt;
    slot = half.third;
  }
  return edges;
}

}  // namespace farhorizon

#include "core/simplify/mesh_edges.h"

#include <algorithm>
#include <tuple>

namespace farhorizon {

std::optional<std::vector<MeshEdge>> EdgesOf(const std::vector<Triangle>& triangles) {
  struct Side {
    Edge edge;
    bool left;  // the triangle is on the left of a -> b
    VertexId third;
  };
  std::vector<Side> sides;
  sides.reserve(triangles.size() * 3);
  for (const Triangle& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId from = t[k];
      const VertexId to = t[(k + 1) % 3];
      sides.push_back({MakeEdge(from, to), from < to, t[(k + 2) % 3]});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& p, const Side& q) {
    return std::tie(p.edge, p.left, p.third) < std::tie(q.edge, q.left, q.third);
  });
  std::vector<MeshEdge> edges;
  edges.reserve(sides.size() / 2);
  for (const Side& side : sides) {
    if (edges.empty() || edges.back().edge != side.edge) edges.push_back({side.edge, {}, {}});
    std::optional<VertexId>& slot = side.left ? edges.back().left : edges.back().right;
    if (slot) return std::nullopt;
    slot = side.third;
  }
  return edges;
}

}  // namespace farhorizon

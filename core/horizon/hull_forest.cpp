#include "core/horizon/horizon.h"

namespace farhorizon {

bool HullForest::Hides(VertexId u, std::int32_t height_u, VertexId w, std::int32_t height_w) const {
  if (height_u < height_w) return Hides(w, height_w, u, height_u);
  // Both ends must be in one hull of the ground at or above the level of the higher one.
  const auto node_at = [&](VertexId v) -> std::int32_t {
    if (covered_level[static_cast<std::size_t>(v)] < height_u) return -1;
    std::int32_t node = cluster[static_cast<std::size_t>(v)];
    while (node >= 0 && parent[static_cast<std::size_t>(node)] >= 0 &&
           merge_level[static_cast<std::size_t>(node)] >= height_u) {
      node = parent[static_cast<std::size_t>(node)];
    }
    return node;
  };
  const std::int32_t node = node_at(u);
  return node >= 0 && node == node_at(w);
}

}  // namespace farhorizon

#include "core/horizon/hull_merge_tree.h"

namespace farhorizon {

bool HullMergeTree::Hides(VertexId u, VertexId w, std::int32_t level) const {
  const auto node_at_level = [&](VertexId v) -> std::int32_t {
    if (enclosed_height[static_cast<std::size_t>(v)] < level) return -1;
    std::int32_t node = cluster[static_cast<std::size_t>(v)];
    while (node >= 0 && parent[static_cast<std::size_t>(node)] >= 0 &&
           merge_height[static_cast<std::size_t>(node)] >= level) {
      node = parent[static_cast<std::size_t>(node)];
    }
    return node;
  };
  const std::int32_t node = node_at_level(u);
  return node >= 0 && node == node_at_level(w);
}

}  // namespace farhorizon

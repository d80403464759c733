#include "core/horizon/hull_merge_tree.h"

#include <cstddef>

namespace farhorizon {

HullMergeTree::HullMergeTree(std::int64_t post_count)
    : enclosed_height_(static_cast<std::size_t>(post_count), kNoHeight),
      node_of_post_(static_cast<std::size_t>(post_count), kNone) {}

HullMergeTree::NodeId HullMergeTree::AddNode() {
  parent_.push_back(kNone);
  merge_height_.push_back(kNoHeight);
  return static_cast<NodeId>(parent_.size()) - 1;
}

void HullMergeTree::Merge(NodeId lost, NodeId into, std::int32_t height) {
  parent_[static_cast<std::size_t>(lost)] = into;
  merge_height_[static_cast<std::size_t>(lost)] = height;
}

// Heights of merges fall from a node to its root, so the hull at `height` is the last node on the
// way to the root that is reached by merges at or above it.
bool HullMergeTree::Occludes(VertexId u, VertexId w, std::int32_t height) const {
  const auto hull_around = [&](VertexId v) -> NodeId {
    if (enclosed_height_[static_cast<std::size_t>(v)] < height) return kNone;
    NodeId node = NodeOf(v);
    while (node >= 0 && parent_[static_cast<std::size_t>(node)] >= 0 &&
           merge_height_[static_cast<std::size_t>(node)] >= height) {
      node = parent_[static_cast<std::size_t>(node)];
    }
    return node;
  };
  const NodeId node = hull_around(u);
  return node >= 0 && node == hull_around(w);
}

}  // namespace farhorizon

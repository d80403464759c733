#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/terrain/dem.h"

namespace farhorizon {

/// Which merged hull encloses each post, from which height on, and which hulls merge at which
/// height (core/horizon/README.md, theorems 4 and 5). While the sweep plane falls, posts are
/// enclosed and hulls merge; a node of the tree is a hull before its merge into another one.
///
/// It is a bound from below for the visual hull of each slice: "occluded" is certain, "visible" is
/// not known.
class HullMergeTree {
 public:
  using NodeId = std::int32_t;
  static constexpr NodeId kNone = -1;

  HullMergeTree() = default;
  explicit HullMergeTree(std::int64_t post_count);

  /// True only if every line that crosses the segment between posts u and w in plan meets ground at
  /// or above `height`. Then the segment, with no end above `height`, does not raise the skyline,
  /// in whatever mesh it is. False: not known.
  [[nodiscard]] bool Occludes(VertexId u, VertexId w, std::int32_t height) const;

  /// The building of the tree, from the summit down. A new node, of a hull that starts.
  NodeId AddNode();
  /// The hull `lost` becomes part of the hull `into` at `height`.
  /// Requires: both are roots, and no merge before was at a lower height.
  void Merge(NodeId lost, NodeId into, std::int32_t height);
  /// The hull `node` encloses `post` from `height` on. Requires: no hull did so before.
  void Enclose(VertexId post, NodeId node, std::int32_t height) {
    enclosed_height_[static_cast<std::size_t>(post)] = height;
    node_of_post_[static_cast<std::size_t>(post)] = node;
  }

  /// The node that enclosed the post first; kNone where none does yet.
  [[nodiscard]] NodeId NodeOf(VertexId post) const {
    return node_of_post_[static_cast<std::size_t>(post)];
  }
  /// NodeOf of all posts.
  [[nodiscard]] std::span<const NodeId> nodes_of_posts() const { return node_of_post_; }

 private:
  std::vector<std::int32_t> enclosed_height_;  ///< per post; kNoHeight where no hull encloses it
  std::vector<NodeId> node_of_post_;           ///< per post
  std::vector<NodeId> parent_;                 ///< per node; kNone at a root
  std::vector<std::int32_t> merge_height_;     ///< per node, with its parent
};

}  // namespace farhorizon

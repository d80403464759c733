// Changes are only marked (dirty) when they come; Update merges the marked nodes anew, level by
// level from the leaves, and marks a parent only where its child's hull has changed. So several
// changes at one depth cost one pass.
#include "core/horizon/kinetic/hulls/hull_forest.h"

#include <algorithm>

namespace farhorizon::kinetic {

void HullForest::MarkDirty(Tree& tree, std::size_t level, std::int32_t hull) {
  Hull& marked = tree.nodes[level][Index(hull / 2)][Index(hull % 2)];
  if (std::exchange(marked.dirty, true)) return;
  tree.dirty[level].push_back(hull);
}

void HullForest::AddLeaf(Tree& tree, PointId p) {
  const std::size_t leaf = tree.leaves.size();
  tree.leaves.push_back(p);
  ++tree.points;
  if (tree.nodes.empty() || leaf >> tree.nodes.size() != 0) {
    const std::size_t top = tree.nodes.size();
    tree.nodes.emplace_back(1);
    tree.dirty.emplace_back();
    MarkDirty(tree, top, 0);
    MarkDirty(tree, top, 1);
  }
  for (std::size_t level = 0; level < tree.nodes.size(); ++level) {
    const std::size_t needed = (leaf >> (level + 1)) + 1;
    if (tree.nodes[level].size() < needed) tree.nodes[level].resize(needed);
  }
  const auto parent = static_cast<std::int32_t>(leaf / 2);
  MarkDirty(tree, 0, 2 * parent);
  MarkDirty(tree, 0, 2 * parent + 1);
}

void HullForest::Insert(ClusterId c, PointId p) {
  Tree& tree = trees_[Index(c)];
  if (Index(p) >= leaf_of_.size()) leaf_of_.resize(Index(p) + 1, {-1, -1});
  leaf_of_[Index(p)] = {c, static_cast<std::int32_t>(tree.leaves.size())};
  AddLeaf(tree, p);
}

void HullForest::Erase(PointId p) {
  if (Index(p) >= leaf_of_.size() || leaf_of_[Index(p)].first < 0) return;
  const auto [c, leaf] = std::exchange(leaf_of_[Index(p)], {-1, -1});
  Tree& tree = trees_[Index(c)];
  tree.leaves[Index(leaf)] = -1;
  --tree.points;
  // Any share is sound; with this one the tree is a level or two higher than it has to be.
  constexpr std::size_t kMostLeavesAPoint = 4;
  constexpr std::size_t kFewLeaves = 64;
  if (tree.leaves.size() > kFewLeaves + kMostLeavesAPoint * Index(tree.points)) {
    Rebuild(c, tree.leaves);
    return;
  }
  MarkDirty(tree, 0, leaf / 2 * 2);
  MarkDirty(tree, 0, leaf / 2 * 2 + 1);
}

void HullForest::Clear(Tree& tree) {
  for (const std::vector<Node>& level : tree.nodes) {
    for (const Node& node : level) {
      for (const Hull& hull : node) {
        if (hull.id < 0) continue;
        queue_.Cancel(CertificateKind::kTree, hull.id);
        free_ids_.push_back(hull.id);
      }
    }
  }
  tree = {};
}

void HullForest::Rebuild(ClusterId c, const std::vector<PointId>& points) {
  const std::vector<PointId> all = points;  // may be of the tree itself
  Clear(trees_[Index(c)]);
  for (const PointId p : all) {
    if (p >= 0) Insert(c, p);
  }
}

void HullForest::Join(ClusterId kept, ClusterId lost) {
  std::vector<PointId> points = trees_[Index(kept)].leaves;
  const std::vector<PointId>& more = trees_[Index(lost)].leaves;
  points.insert(points.end(), more.begin(), more.end());
  Clear(trees_[Index(lost)]);
  Rebuild(kept, points);
}

ClusterId HullForest::Fail(std::int32_t id) {
  const Place& place = places_[Index(id)];
  Tree& tree = trees_[Index(place.cluster)];
  const Hull& hull = tree.nodes[Index(place.level)][Index(place.hull / 2)][Index(place.hull % 2)];
  ++failures_[static_cast<std::size_t>(hull.failing)];
  MarkDirty(tree, Index(place.level), place.hull);
  return place.cluster;
}

// Of the child 0 or 1 of a node.
std::span<const PointId> HullForest::ChainBelow(const Tree& tree, std::size_t level,
                                                std::int32_t hull, std::int32_t child) {
  const std::size_t below = Index(hull / 2 * 2 + child);
  if (level == 0) {
    if (below >= tree.leaves.size() || tree.leaves[below] < 0) return {};
    return std::span(tree.leaves).subspan(below, 1);
  }
  if (below >= tree.nodes[level - 1].size()) return {};
  return tree.nodes[level - 1][below][Index(hull % 2)].chain;
}

std::int32_t HullForest::NewId(const Place& place) {
  auto id = static_cast<std::int32_t>(places_.size());
  if (free_ids_.empty()) {
    places_.emplace_back();
  } else {
    id = free_ids_.back();
    free_ids_.pop_back();
  }
  places_[Index(id)] = place;
  return id;
}

void HullForest::Update(ClusterId c, std::span<const KineticPoint> points, const SweepDepth& now) {
  Tree& tree = trees_[Index(c)];
  std::array<ChainMerger, 2> mergers{ChainMerger(points, now, 1), ChainMerger(points, now, -1)};
  for (std::size_t level = 0; level < tree.nodes.size(); ++level) {
    for (const std::int32_t at : tree.dirty[level]) {
      Hull& hull = tree.nodes[level][Index(at / 2)][Index(at % 2)];
      hull.dirty = false;
      ChainMerge merged = mergers[Index(at % 2)].Merge(ChainBelow(tree, level, at, 0),
                                                       ChainBelow(tree, level, at, 1));
      if (hull.id < 0 && merged.failure) {
        hull.id = NewId({c, static_cast<std::int32_t>(level), at});
      }
      if (hull.id >= 0) queue_.Schedule(CertificateKind::kTree, hull.id, merged.failure);
      hull.failing = merged.failing;
      if (merged.chain == hull.chain) continue;
      hull.chain = std::move(merged.chain);
      if (level + 1 < tree.nodes.size()) MarkDirty(tree, level + 1, at / 4 * 2 + at % 2);
    }
    tree.dirty[level].clear();
  }
}

// Each hull is from its left to its right, as it sees them, so clockwise.
std::vector<PointId> HullForest::Corners(ClusterId c) const {
  const Tree& tree = trees_[Index(c)];
  if (tree.nodes.empty()) return {};
  const Node& root = tree.nodes.back()[0];
  std::vector<PointId> ring(root[0].chain.rbegin(), root[0].chain.rend());
  const std::vector<PointId>& lower = root[1].chain;
  if (lower.size() > 2) ring.insert(ring.end(), lower.rbegin() + 1, lower.rend() - 1);
  return ring;
}

}  // namespace farhorizon::kinetic

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/horizon/kinetic/hulls/certificate_queue.h"
#include "core/horizon/kinetic/hulls/chain_merge.h"
#include "core/horizon/kinetic/hulls/kinetic_point.h"
#include "core/horizon/kinetic/hulls/step_marks.h"
#include "core/horizon/kinetic/hulls/sweep_depth.h"

namespace farhorizon::kinetic {

/// The kinetic hulls of [BaschGuibasHershberger97], one for each cluster: a binary tree over its
/// points in the order in which they came. Each node has the upper hull and the lower hull of the
/// points below it, merged from those of its children, and the certificates of the merge.
///
///             root: the hull           A point is added to the right, which adds a path; where the
///            /            \            tree is full, it gets a new root with the old one on the
///        node              node        left. A point that is removed leaves its leaf empty; where
///       /    \            /    \       most leaves are empty, the tree is built anew, and so is
///     p1      p2        p3      -      that of two clusters that are joined [Archambault03,
///                                      section 3.2.4].
///
/// A node has one event in the queue for each of its two hulls: the first of its certificates to
/// fail. It is then merged anew from its children, and so is its parent if its hull has changed,
/// up to the root; so simultaneous events need no order.
class HullForest {
 public:
  /// Requires: `queue` outlives it.
  explicit HullForest(CertificateQueue& queue) : queue_(queue) {}

  void AddCluster() { trees_.emplace_back(); }
  /// A point of c's tree from the next Update() on.
  void Insert(ClusterId c, PointId p);
  /// No longer, from the next Update() on. Nothing happens where it is in no tree.
  void Erase(PointId p);
  void Join(ClusterId kept, ClusterId lost);
  /// A certificate has failed. Returns whose.
  ClusterId Fail(std::int32_t id);

  /// Makes the hulls of c true just after `now`. Cost: O(h log n) for each node on the paths from
  /// the leaves and the nodes that changed, h corners there and n certificates.
  void Update(ClusterId c, std::span<const KineticPoint> points, const SweepDepth& now);
  /// The corners, counter-clockwise; neighbours may be one point for ever.
  [[nodiscard]] std::vector<PointId> Corners(ClusterId c) const;

  /// Certificates that failed, by ChainCertificate.
  [[nodiscard]] const std::array<std::int64_t, kChainCertificates>& failures() const {
    return failures_;
  }

 private:
  struct Hull {
    std::vector<PointId> chain;
    std::int32_t id = -1;  ///< of its event
    ChainCertificate failing = ChainCertificate::kX;
    bool dirty = false;
  };
  using Node = std::array<Hull, 2>;  ///< upper, lower
  struct Tree {
    std::vector<PointId> leaves;                   ///< -1: empty
    std::vector<std::vector<Node>> nodes;          ///< by level above the leaves
    std::vector<std::vector<std::int32_t>> dirty;  ///< by level: 2 * node + 0 or 1
    std::int32_t points = 0;
  };
  struct Place {
    ClusterId cluster = -1;
    std::int32_t level = 0;
    std::int32_t hull = 0;  ///< 2 * node + 0 or 1
  };

  void MarkDirty(Tree& tree, std::size_t level, std::int32_t hull);
  void AddLeaf(Tree& tree, PointId p);
  void Clear(Tree& tree);
  void Rebuild(ClusterId c, const std::vector<PointId>& points);
  [[nodiscard]] static std::span<const PointId> ChainBelow(const Tree& tree, std::size_t level,
                                                           std::int32_t hull, std::int32_t child);
  std::int32_t NewId(const Place& place);

  CertificateQueue& queue_;
  std::vector<Tree> trees_;                                  // by cluster
  std::vector<std::pair<ClusterId, std::int32_t>> leaf_of_;  // by point; -1: in no tree
  std::vector<Place> places_;                                // by id
  std::vector<std::int32_t> free_ids_;
  std::array<std::int64_t, kChainCertificates> failures_{};
};

}  // namespace farhorizon::kinetic

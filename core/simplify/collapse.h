#pragma once

#include <cstdint>
#include <functional>
#include <unordered_set>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/simplify/posts_by_triangle.h"
#include "core/simplify/star.h"
#include "core/simplify/surface.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// What every collapse of a level must keep to.
struct CollapseRules {
  TriangleLimits limits;
  /// Per post: whether it may be removed. A post on the outline is removed on straight runs only.
  std::vector<bool> removable;
  /// Whether a new edge between two posts is allowed. Called late, and only for edges that rise
  /// above the surface that they replace.
  std::function<bool(VertexId, VertexId)> may_add_edge;
  /// Whether the ridges allow that `v` is moved onto `b`. Cheap; called often.
  std::function<bool(VertexId v, VertexId b)> may_move;
  /// Moves the ridges of `v` to `b`; false, and nothing is changed, if that is not allowed. Called
  /// last.
  std::function<bool(VertexId v, VertexId b)> move_ridges;
};

/// Half-edge collapses in ascending order of cost until no more are allowed, level after level.
///
/// After [GarlandHeckbert97], except that the cost is measured, not estimated: the increase of the
/// sum of squared vertical errors at the posts. Of equal costs the lower post comes first. A cost
/// in the queue is recomputed when it comes first and is out of date.
class Collapser {
 public:
  explicit Collapser(const Terrain& terrain);

  /// Collapses under `rules` until no vertex can be removed.
  /// report: called with the share of the triangles that are gone.
  /// Errors: kCancelled. Cost: about n log n, and the posts under a star for each collapse tried.
  Status Run(const CollapseRules& rules, const RunControl& control,
             const std::function<void(double)>& report);

  [[nodiscard]] const Surface& surface() const { return surface_; }

 private:
  struct Entry {
    double cost;
    VertexId v;
  };
  static bool Later(const Entry& p, const Entry& q) {
    return p.cost > q.cost || (p.cost == q.cost && p.v > q.v);
  }

  void Start(const CollapseRules& rules);
  void Enqueue(double cost, VertexId v);
  Entry Dequeue();
  void Rate(const CollapseRules& rules, VertexId v);
  bool TryCollapse(const CollapseRules& rules, VertexId v);
  void MarkNeighboursStale();
  [[nodiscard]] bool Refused(VertexId v, VertexId b) const;
  void Refuse(std::unordered_set<std::uint64_t>& set, VertexId p, VertexId q);

  const Terrain* terrain_;
  Surface surface_;
  PostsByTriangle posts_by_triangle_;
  Star star_;
  std::vector<bool> pinched_;  // per post: fans meet there that share nothing but the post

  std::vector<Entry> queue_;      // a heap, at most one entry a vertex
  std::vector<bool> queued_;      // per post
  std::vector<bool> stale_;       // per post: its star has changed since its cost was computed
  std::vector<VertexId> target_;  // per post: the neighbour onto which it would be moved
  double last_cost_ = 0;          // of the collapse done last

  std::unordered_set<std::uint64_t> refused_edges_;  // not allowed at this level
  std::unordered_set<std::uint64_t> refused_moves_;  // not allowed by the ridges
  std::vector<bool> has_refusal_;                    // per post: whether it is in either set
  std::vector<VertexId> others_;
};

}  // namespace farhorizon

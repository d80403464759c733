#pragma once

#include <cstdint>
#include <functional>
#include <unordered_set>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/simplify/posts_by_triangle.h"
#include "core/simplify/star.h"
#include "core/simplify/surface.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// What a level asks of every collapse beside the shape of triangles.
struct CollapseRules {
  TriangleLimits limits;
  /// Per post: whether it may leave at all. A post on the outline leaves along straight runs only.
  std::vector<bool> may_leave;
  /// Whether a new edge between two posts may stand. Asked as late as possible, and only where the
  /// edge would rise above the surface it replaces.
  std::function<bool(VertexId, VertexId)> may_stand;
  /// Whether `v` may move onto `b` as far as the ridges are concerned. Cheap, asked often.
  std::function<bool(VertexId v, VertexId b)> may_move;
  /// Moves the ridges along, or refuses and leaves them as they were. Asked last.
  std::function<bool(VertexId v, VertexId b)> move_ridges;
};

/// Half-edge collapses by rising cost until nothing more is allowed, level after level.
///
/// After [GarlandHeckbert97], but the cost is measured, not estimated: what the collapse adds to
/// the sum of squared vertical errors at the posts. Ties go to the lower post. Costs in the queue
/// are brought up to date when their turn comes.
class Collapser {
 public:
  explicit Collapser(const Terrain& terrain);

  /// Collapses under `rules` for as long as any vertex may go.
  /// report: called with the share of the vertices that were looked at or removed.
  /// Errors: kCancelled. Cost: about n log n, and the posts under a star for each collapse tried.
  Status Run(const CollapseRules& rules, const Watch& watch,
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
  void TouchAround();
  [[nodiscard]] bool Refused(VertexId v, VertexId b) const;
  void Refuse(std::unordered_set<std::uint64_t>& set, VertexId p, VertexId q);

  const Terrain* terrain_;
  Surface surface_;
  Coverage coverage_;
  Star star_;
  std::vector<bool> pinched_;  // posts where fans meet that share nothing else

  std::vector<Entry> queue_;      // a heap, at most one entry a vertex
  std::vector<bool> queued_;      // per post
  std::vector<bool> stale_;       // per post: its surroundings have changed since it was rated
  std::vector<VertexId> target_;  // per post: where it would go
  double floor_ = 0;              // the cost of the collapse done last

  std::unordered_set<std::uint64_t> refused_edges_;  // may not stand at this level
  std::unordered_set<std::uint64_t> refused_moves_;  // the ridges did not allow it
  std::vector<bool> has_refusal_;                    // per post: worth asking the sets
  std::vector<VertexId> others_;
};

}  // namespace farhorizon

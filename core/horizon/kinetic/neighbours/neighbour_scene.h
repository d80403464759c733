#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/horizon/kinetic/hulls/certificate_queue.h"
#include "core/horizon/kinetic/hulls/kinetic_hulls.h"
#include "core/horizon/kinetic/hulls/moving_point.h"
#include "core/horizon/kinetic/hulls/plan_box.h"
#include "core/horizon/kinetic/hulls/scene_counts.h"
#include "core/horizon/kinetic/hulls/step_marks.h"
#include "core/horizon/kinetic/hulls/sweep_depth.h"
#include "core/horizon/kinetic/neighbours/separating_tangents.h"

namespace farhorizon::kinetic {

/// The slice of the terrain at one depth: disjoint convex hulls of moving points, the tangents of
/// neighbouring hulls, and at each corner whether a line of sight was ever there. What chapter 3 of
/// [Archambault03] keeps besides, all bitangents and which of them are active, is in a
/// BitangentScene; here only what can still change the answer is kept (core/horizon/README.md,
/// section 11):
///
///  - *keep* of the thesis, OnHorizon(), is true at the points at which a visual gap of positive
///    width was at some depth. It stays, so nothing is kept for these corners any more.
///  - Each other corner is *hidden*: a cover (line_pencil.h) proves that hulls occlude all lines
///    that touch its hull there. Its failure is an event; then the corner is asked about anew.
///  - Each hull has an octagon around it. Two hulls are *neighbours* where these intersect, and
///    then a separating tangent proves that they are disjoint.
///
/// These invariants hold at each depth except while its events are dealt with. Memory: O(n + m) for
/// n points and m hulls that have O(1) neighbours each; no bitangent is kept for its own sake.
///
/// The caller goes from event to event (algorithm 3.1 of the thesis):
///
///     Advance(now)            takes the failed certificates out of the queue
///     Add, Join, Remove ...   what happens to the terrain at this depth
///     RestoreInvariants()     makes everything true just after `now`, in these steps:
///
/// 1. *Hulls.* Each hull that changed gets its corners anew. Corners with other neighbours than
///    before are displaced (step_marks.h), others keep all that they have (figure 3.9 B of the
///    thesis).
/// 2. *Collisions.* Octagons grow, separating tangents walk to where they separate their hulls, new
///    neighbours get one. Two hulls that have come to intersect are joined, and step 1 follows.
/// 3. *Lines of sight.* Displaced corners, and those whose cover failed, are asked about.
/// 4. *Interior points.* Points that are no corners get a certificate that they stay none.
///
/// Simultaneous events are one such step: nothing is perturbed, since each question is about what
/// is true just after `now`, and is answered from the paths of the points alone.
class NeighbourScene {
 public:
  /// most_looks: SceneCounts::looks after which a step ends early and leaves the scene unfit.
  explicit NeighbourScene(HullCertificates certificates = HullCertificates::kTurns,
                          std::int64_t most_looks = std::int64_t{1} << 62)
      : hulls_(queue_, marks_, certificates), most_looks_(most_looks) {}
  NeighbourScene(const NeighbourScene&) = delete;
  NeighbourScene& operator=(const NeighbourScene&) = delete;

  /// A point that is in `cluster` from the coming RestoreInvariants() until depth `end`; the caller
  /// removes it there. tag: the caller's; points of negative tag are never asked about.
  PointId Add(ClusterId cluster, const MovingPoint& path, std::int64_t end, std::int32_t tag);
  ClusterId NewCluster();
  /// Makes the two one: connected ground. Returns the one that is left.
  ClusterId Join(ClusterId a, ClusterId b);
  /// The point is no longer there, from the coming RestoreInvariants() on.
  void Remove(PointId p);
  /// The cluster that `cluster` has become part of.
  [[nodiscard]] ClusterId Find(ClusterId cluster) const { return hulls_.Find(cluster); }

  /// The depth of the next event.
  std::optional<SweepDepth> NextEvent() { return queue_.NextDepth(); }
  /// Requires: no event is before `now`.
  void Advance(const SweepDepth& now);
  void RestoreInvariants();

  /// Whether a visual gap of positive width was at the point at some depth.
  [[nodiscard]] bool OnHorizon(PointId p) const { return on_horizon_[Index(p)]; }
  /// An octagon that contains the hull.
  [[nodiscard]] const PlanBox& box(ClusterId c) const { return boxes_[Index(c)]; }

  [[nodiscard]] const KineticHulls& hulls() const { return hulls_; }
  [[nodiscard]] const SceneCounts& counts() const { return counts_; }
  /// Certificates that have an event to come.
  [[nodiscard]] std::int64_t queue_size() const { return queue_.pending(); }

  /// Throws InternalError where an invariant does not hold just after the depth gone to: for tests.
  void CheckAll() const;

 private:
  void UpdateHulls();
  [[nodiscard]] bool JoinIntersecting();
  [[nodiscard]] bool JoinNeighbours();
  [[nodiscard]] bool RestoreTangents();
  void GrowBox(ClusterId c);
  void FindVisualGaps();
  void AskCorner(PointId p);
  void MarkGrown(ClusterId c);
  [[nodiscard]] bool OverBudget() const { return counts_.looks > most_looks_; }

  CertificateQueue queue_;
  StepMarks marks_;
  KineticHulls hulls_;
  SeparatingTangents tangents_{queue_, hulls_};
  std::vector<PlanBox> boxes_;                  // by cluster
  std::vector<std::vector<ClusterId>> recent_;  // by cluster: hulls that occluded its corners last
  std::vector<bool> on_horizon_;                // by point
  std::vector<ClusterId> updated_;              // hulls updated since their tangents were restored
  std::vector<ClusterId> grown_;                // clusters whose octagons grew in this step
  std::vector<bool> is_grown_;                  // by cluster: whether it is there
  std::vector<TangentId> failed_tangents_;
  std::vector<PointId> failed_covers_;
  std::int64_t most_looks_;
  SceneCounts counts_;
};

}  // namespace farhorizon::kinetic

#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/horizon/kinetic/certificate_queue.h"
#include "core/horizon/kinetic/kinetic_hulls.h"
#include "core/horizon/kinetic/moving_point.h"
#include "core/horizon/kinetic/plan_box.h"
#include "core/horizon/kinetic/scene_counts.h"
#include "core/horizon/kinetic/separating_tangents.h"
#include "core/horizon/kinetic/step_marks.h"
#include "core/horizon/kinetic/sweep_depth.h"

namespace farhorizon::kinetic {

class NeighbourScene {
 public:
  NeighbourScene() = default;
  NeighbourScene(const NeighbourScene&) = delete;
  NeighbourScene& operator=(const NeighbourScene&) = delete;

  /// A point that is in `cluster` from the coming RestoreInvariants() until depth `end`; the caller
  /// removes it there. tag: the caller's; corners of negative tag are not asked about.
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
  void GrowBoxes();
  void FindVisualGaps();
  void AskCorner(PointId p);

  CertificateQueue queue_;
  StepMarks marks_;
  KineticHulls hulls_{queue_, marks_};
  SeparatingTangents tangents_{queue_, hulls_};
  std::vector<PlanBox> boxes_;                  // by cluster
  std::vector<std::vector<ClusterId>> recent_;  // by cluster: hulls that occluded its corners last
  std::vector<bool> on_horizon_;                // by point
  std::vector<ClusterId> grown_;                // clusters whose boxes grew in this step
  std::vector<TangentId> failed_tangents_;
  std::vector<PointId> failed_covers_;
  SceneCounts counts_;
};

}  // namespace farhorizon::kinetic

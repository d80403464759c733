#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/horizon/kinetic/bitangents/collinear_event.h"
#include "core/horizon/kinetic/bitangents/corner_order.h"
#include "core/horizon/kinetic/bitangents/occlusion_depths.h"
#include "core/horizon/kinetic/bitangents/tangent_certificates.h"
#include "core/horizon/kinetic/bitangents/tangent_motion.h"
#include "core/horizon/kinetic/bitangents/tangent_table.h"
#include "core/horizon/kinetic/hulls/certificate_queue.h"
#include "core/horizon/kinetic/hulls/kinetic_hulls.h"
#include "core/horizon/kinetic/hulls/moving_point.h"
#include "core/horizon/kinetic/hulls/plan_box.h"
#include "core/horizon/kinetic/hulls/scene_counts.h"
#include "core/horizon/kinetic/hulls/step_marks.h"
#include "core/horizon/kinetic/hulls/sweep_depth.h"

namespace farhorizon::kinetic {

/// The slice of the terrain at one depth, as chapter 3 of [Archambault03] keeps it: disjoint convex
/// hulls of moving points, the bitangents of each two of them, and the visual gaps at their
/// corners. In place of contours it has merged hulls, which occlude the same lines
/// (core/horizon/README.md, theorem 4). It takes O(m^2) for m hulls; what the horizon needs of it
/// is in a NeighbourScene, and this one is the chapter itself, for pictures and tests.
///
/// The invariants are in the headers of the parts: certificate_queue.h, kinetic_hulls.h,
/// tangent_table.h, tangent_certificates.h, corner_order.h and occlusion_depths.h. They hold at
/// each depth except while its events are dealt with.
///
/// The caller goes from event to event (algorithm 3.1 of the thesis):
///
///     Advance(now)            takes the failed certificates out of the queue and marks what they
///                             tell of, by step_marks.h
///     Add, Join, Remove ...   what happens to the terrain at this depth
///     RestoreInvariants()     makes everything true just after `now`, in these steps:
///
/// 1. *Hulls.* Each hull that changed gets its corners anew. A corner with other neighbours than
///    before, or that is none any more, is displaced: a tangent may not support the hull there.
/// 2. *Collisions.* Two hulls that have come to intersect are joined, and step 1 follows again. The
///    tangents of both are dropped; what they occluded is remembered for step 5.
/// 3. *Collinear corners.* If three corners in line are all that happens, the order at each is
///    exchanged in place (collinear_event.h). Else the corners of all failed certificates are
///    stale: their order is found anew in step 7. Inactive tangents in line with an edge of their
///    own hull are moved across it, or displace their corners.
/// 4. *Displaced corners.* Tangents there walk to where they support their hulls. What they leave
///    is displaced in turn, where they come to is stale.
/// 5. *Pairs.* Each new hull gets tangents with each other hull, and occludes lines at its corners;
///    then what dropped tangents occluded is released.
/// 6. *Propagation.* Until no corner is marked any more: what stale corners make stale or displaced
///    beside them; step 4 for these; depths are counted anew where corners or tangents moved.
/// 7. *Rebuilding.* The order at each stale corner is found anew from its depth and its tangents.
/// 8. *Interior points.* All points that are no corners get a triangle of their hull.
///
/// Simultaneous events are one such step: nothing is perturbed. What is still in line just after is
/// so for good, and such ties are broken by one rule (TangentTable::Before).
///
/// Ground at or above the plane only grows, so visual lines are never born: a tangent becomes
/// active only where it passes an active one, or where its hulls are new.
class BitangentScene {
 public:
  /// most_looks: as of a NeighbourScene; not heeded inside a step.
  explicit BitangentScene(HullCertificates certificates = HullCertificates::kTurns,
                          std::int64_t /*most_looks*/ = 0)
      : hulls_(queue_, marks_, certificates) {
    everywhere_.AddAll();
  }
  BitangentScene(const BitangentScene&) = delete;
  BitangentScene& operator=(const BitangentScene&) = delete;

  /// A point that is in `cluster` from the coming RestoreInvariants() until depth `end`; the caller
  /// removes it there. tag: the caller's.
  PointId Add(ClusterId cluster, const MovingPoint& path, std::int64_t end, std::int32_t tag);
  ClusterId NewCluster();
  /// Makes the two one: connected ground. Returns the one that is left.
  ClusterId Join(ClusterId a, ClusterId b);
  /// The point is no longer there, from the coming RestoreInvariants() on.
  void Remove(PointId p) { hulls_.Remove(p); }
  /// The cluster that `cluster` has become part of.
  [[nodiscard]] ClusterId Find(ClusterId cluster) const { return hulls_.Find(cluster); }

  /// The depth of the next event.
  std::optional<SweepDepth> NextEvent() { return queue_.NextDepth(); }
  /// Requires: no event is before `now`.
  void Advance(const SweepDepth& now);
  void RestoreInvariants();

  /// Whether a visual gap of positive width was at the point at some depth.
  [[nodiscard]] bool OnHorizon(PointId p) const { return order_.corner(p).on_horizon; }
  /// The whole plan: where hulls are is not kept.
  [[nodiscard]] const PlanBox& box(ClusterId /*c*/) const { return everywhere_; }

  [[nodiscard]] const KineticHulls& hulls() const { return hulls_; }
  [[nodiscard]] const TangentTable& tangents() const { return tangents_; }
  [[nodiscard]] const CornerOrder& order() const { return order_; }
  [[nodiscard]] const TangentCertificates& certificates() const { return certificates_; }
  [[nodiscard]] const SceneCounts& counts() const { return counts_; }
  /// Certificates that have an event to come.
  [[nodiscard]] std::int64_t queue_size() const { return queue_.pending(); }

  /// Throws InternalError where an invariant does not hold just after the depth gone to: for tests.
  void CheckAll() const;

 private:
  void FailTangent(HalfTangentId half, std::size_t which);
  void UpdateHulls();
  [[nodiscard]] bool JoinIntersecting();
  [[nodiscard]] bool JoinNewHull();
  [[nodiscard]] bool JoinAcross(HalfTangentId half);
  void MakeTangentsOfNewHulls();
  void MakeTangents(ClusterId a, ClusterId b);
  void DropTangents(ClusterId a, ClusterId b);
  void PropagateMarks();
  void RebuildStale();

  CertificateQueue queue_;
  StepMarks marks_;
  KineticHulls hulls_;
  TangentTable tangents_{hulls_};
  TangentCertificates certificates_{queue_, hulls_, tangents_};
  CornerOrder order_{hulls_, tangents_, certificates_, marks_};
  OcclusionDepths depths_{hulls_, tangents_, order_, marks_};
  TangentMotion motion_{hulls_, tangents_, certificates_, order_, marks_};
  CollinearEvents collinear_{hulls_, tangents_, certificates_, order_, marks_};
  PlanBox everywhere_;
  SceneCounts counts_;
};

}  // namespace farhorizon::kinetic

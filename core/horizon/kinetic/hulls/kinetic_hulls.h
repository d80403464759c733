#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/horizon/kinetic/hulls/certificate_queue.h"
#include "core/horizon/kinetic/hulls/hull_certificates.h"
#include "core/horizon/kinetic/hulls/hull_forest.h"
#include "core/horizon/kinetic/hulls/kinetic_point.h"
#include "core/horizon/kinetic/hulls/moving_point.h"
#include "core/horizon/kinetic/hulls/scene_counts.h"
#include "core/horizon/kinetic/hulls/step_marks.h"
#include "core/horizon/kinetic/hulls/sweep_depth.h"

namespace farhorizon::kinetic {

struct KineticHull {
  std::vector<PointId> corners;    ///< counter-clockwise; none if it was joined to another
  std::vector<PointId> unlocated;  ///< points that are to become corners or to get a triangle
  bool corners_stale = false;      ///< the corners are to be found anew
  bool joined = false;             ///< the corners are those of two hulls
  bool is_new = false;             ///< no tangents yet
  bool changed = false;            ///< is in changed()
  bool outdated = false;           ///< is to be updated
};

/// Convex hulls of clusters of moving points, kept by certificates.
///
/// Except while an event is dealt with:
///  - the corners of a cluster run counter-clockwise and each three neighbours turn left strictly;
///    a certificate kHull for each corner;
///  - every other point that is alive lies in a triangle of three corners; a certificate kInterior
///    for it. Points that can never be a corner again are not alive.
/// So the corners are those of the convex hull of the cluster's points. The hulls of different
/// clusters are disjoint: the scene joins those that come to intersect.
///
/// So it is with HullCertificates::kTurns: a failure costs O(h) for h corners, and each interior
/// point has a certificate; but only points on convex edges are kept, and only while they may still
/// come out. With kTree, all points are in the tree of the thesis (hull_forest.h), which has the
/// certificates [Archambault03, section 3.2.4; BaschGuibasHershberger97].
class KineticHulls {
 public:
  /// Requires: both outlive it.
  KineticHulls(CertificateQueue& queue, StepMarks& marks,
               HullCertificates certificates = HullCertificates::kTurns)
      : queue_(queue), marks_(marks) {
    if (certificates == HullCertificates::kTree) forest_.emplace(queue);
  }

  /// A point that is in `cluster` from the next UpdateHull() until depth `end`.
  PointId Add(ClusterId cluster, const MovingPoint& path, std::int64_t end, std::int32_t tag);
  ClusterId NewCluster();
  /// The point is no longer there, from the next UpdateHull() on.
  void Remove(PointId p);
  /// Marks a hull as one without tangents, until the step ends.
  void MarkNew(ClusterId c) { hulls_[Index(c)].is_new = true; }
  /// Gives all points of `lost` to `kept`. Requires: two clusters of clusters().
  void Join(ClusterId kept, ClusterId lost);
  /// The cluster that `cluster` has become part of; itself if it was not joined to another.
  [[nodiscard]] ClusterId Find(ClusterId cluster) const;
  [[nodiscard]] ClusterId ClusterOf(PointId p) const { return Find(point(p).cluster); }

  /// From here on, orientations are those just after `now`.
  void AdvanceTo(const SweepDepth& now) { now_ = now; }
  /// The corners of p's hull are to be found anew: three are in line, or p, a corner, is removed.
  void InvalidateCorners(PointId p);
  /// The interior point has come to the border of its triangle, or a corner of that is removed.
  void InvalidateTriangle(PointId p);

  /// A certificate has failed: deals with it and counts it if it is one of hulls, trees or interior
  /// points. Returns whether it is.
  bool Fail(const Event& event, SceneCounts& counts);

  /// The clusters that changed since they were updated, each once; some may have been joined to
  /// another since. The caller updates those that were not.
  [[nodiscard]] std::vector<ClusterId> TakeOutdated() { return std::exchange(outdated_, {}); }
  /// Finds the corners anew where they changed, and marks those as displaced that have other
  /// neighbours than before. Returns how many of the new ones were interior points.
  std::int64_t UpdateHull(ClusterId c);
  /// Gives the points that became interior ones a triangle and ends the step: no hull is new or
  /// changed then. Requires: every changed hull is up to date.
  void LocateInteriorPoints();

  /// Certificates of trees that failed.
  [[nodiscard]] std::array<std::int64_t, kChainCertificates> tree_failures() const {
    return forest_ ? forest_->failures() : std::array<std::int64_t, kChainCertificates>{};
  }

  [[nodiscard]] const SweepDepth& now() const { return now_; }
  [[nodiscard]] const KineticPoint& point(PointId p) const { return points_[Index(p)]; }
  [[nodiscard]] const MovingPoint& path(PointId p) const { return point(p).path; }
  [[nodiscard]] std::int64_t EndOf(PointId p) const { return point(p).end; }
  [[nodiscard]] PointId point_count() const { return static_cast<PointId>(points_.size()); }
  [[nodiscard]] const KineticHull& hull(ClusterId c) const { return hulls_[Index(c)]; }
  [[nodiscard]] const std::vector<PointId>& corners(ClusterId c) const { return hull(c).corners; }
  /// The clusters that were not joined to another, in the order in which they began.
  [[nodiscard]] std::span<const ClusterId> clusters() const { return clusters_; }
  /// The clusters with new points, removed corners or failed certificates in this step, in the
  /// order in which they got them; some may have been joined to another since.
  [[nodiscard]] const std::vector<ClusterId>& changed() const { return changed_; }

  /// The sign of the orientation just after `now`: positive where c is left of ab. 0: for ever.
  [[nodiscard]] int Orient(PointId a, PointId b, PointId c) const {
    return OrientAfter(point(a).path, point(b).path, point(c).path, now_);
  }
  /// The depth at which the first of the three is removed.
  [[nodiscard]] std::int64_t FirstEnd(const std::array<PointId, 3>& points) const;

  /// Throws InternalError where the corners are not those of a convex polygon.
  void CheckHull(ClusterId c) const;
  /// Throws InternalError where a point that is alive is outside its hull.
  void CheckPoints() const;

 private:
  void MarkChanged(ClusterId c);
  [[nodiscard]] std::optional<std::vector<PointId>> CornersByTurns(ClusterId c);
  [[nodiscard]] std::vector<PointId> CornersByTree(ClusterId c);
  void SetCorners(ClusterId c, std::vector<PointId> corners);
  void LocateInterior(PointId p);

  CertificateQueue& queue_;
  StepMarks& marks_;
  std::optional<HullForest> forest_;  // HullCertificates::kTree
  SweepDepth now_;
  std::vector<KineticPoint> points_;
  std::vector<KineticHull> hulls_;
  mutable std::vector<ClusterId> roots_;  // a forest as in union_find.h; Find() shortens its paths
  std::vector<ClusterId> clusters_;
  std::vector<ClusterId> changed_;
  std::vector<ClusterId> outdated_;
  std::vector<PointId> interior_points_;  // that are to be given a triangle
};

}  // namespace farhorizon::kinetic

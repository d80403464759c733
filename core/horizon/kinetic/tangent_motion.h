#pragma once

#include <span>
#include <utility>
#include <vector>

#include "core/horizon/kinetic/corner_order.h"
#include "core/horizon/kinetic/kinetic_hulls.h"
#include "core/horizon/kinetic/step_marks.h"
#include "core/horizon/kinetic/tangent_certificates.h"
#include "core/horizon/kinetic/tangent_table.h"

namespace farhorizon::kinetic {

/// Moves tangents from corner to corner, and finds out which corners are stale for that.
///
/// Certificates tell only where a half tangent meets a partner or an edge of its own hull. What has
/// moved besides is found from there: tangents that deferred to one that moved, ties that end
/// because a point ends, and corners beside.
class TangentMotion {
 public:
  /// Requires: all outlive it.
  TangentMotion(const KineticHulls& hulls, TangentTable& tangents,
                TangentCertificates& certificates, CornerOrder& order, StepMarks& marks)
      : hulls_(hulls),
        tangents_(tangents),
        certificates_(certificates),
        order_(order),
        marks_(marks) {}

  struct Crossing {
    HalfTangentId half;
    PointId corner;  ///< of the half tangent then
  };
  /// An inactive half tangent has come in line with an edge of its own hull.
  void AddCrossing(HalfTangentId half) { crossings_.push_back({half, tangents_.Own(half)}); }
  [[nodiscard]] std::span<const Crossing> crossings() const { return crossings_; }
  /// Moves those across the edge, each by itself where nothing else happens there; where more does,
  /// the corners are marked as displaced. None is left.
  void CrossEdges();

  /// Moves all tangents at displaced corners to where they support their hulls. The corners that a
  /// half tangent leaves are displaced in turn, those that it comes to are stale.
  void WalkDisplaced();
  /// Marks further corners that a stale corner makes displaced or stale.
  void MarkBesideStale(PointId p);
  /// For a half tangent that is about to be dropped: where a point ends just now, corners that its
  /// certificates would have told of are marked stale.
  void MarkCollinearEnd(HalfTangentId half);

 private:
  void Walk(TangentId t);
  [[nodiscard]] bool CrossEdge(HalfTangentId half);
  [[nodiscard]] bool CollinearNow(PointId a, PointId b, PointId c) const;
  [[nodiscard]] bool FailsNow(HalfTangentId half, std::size_t which) const;
  void MarkWithNeighbours(PointId p);

  const KineticHulls& hulls_;
  TangentTable& tangents_;
  TangentCertificates& certificates_;
  CornerOrder& order_;
  StepMarks& marks_;
  std::vector<Crossing> crossings_;
};

}  // namespace farhorizon::kinetic

#pragma once

#include <span>
#include <utility>
#include <vector>

#include "core/horizon/kinetic/bitangents/corner_order.h"
#include "core/horizon/kinetic/bitangents/tangent_certificates.h"
#include "core/horizon/kinetic/bitangents/tangent_table.h"
#include "core/horizon/kinetic/hulls/kinetic_hulls.h"
#include "core/horizon/kinetic/hulls/step_marks.h"

namespace farhorizon::kinetic {

/// Moves tangents from corner to corner, and marks the corners whose order that makes stale.
///
/// A certificate fails only where a half tangent comes in line with a partner or an edge of its own
/// hull. What else moves at the same depth is found from there: half tangents that deferred to one
/// that moved, and those that were in line for this one depth at which a point ends.
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
  /// Moves those across the edge, each by itself, where nothing else happens; where more does,
  /// marks the corners as displaced. No crossing is left.
  void CrossEdges();

  /// Moves all tangents at displaced corners to where they support their hulls. The corners that a
  /// half tangent leaves are displaced in turn, those that it comes to are stale.
  void WalkDisplaced();
  /// Marks further corners that a stale corner makes displaced or stale.
  void MarkBesideStale(PointId p);
  /// For a half tangent that is about to be dropped at a depth at which one of its ends is removed:
  /// marks the corners stale that its certificates, which end there, would have failed at.
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

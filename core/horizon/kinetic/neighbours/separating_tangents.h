#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/horizon/kinetic/hulls/certificate_queue.h"
#include "core/horizon/kinetic/hulls/kinetic_hulls.h"
#include "core/horizon/kinetic/hulls/step_marks.h"

namespace farhorizon::kinetic {

using TangentId = std::int32_t;

/// An inner bitangent of two neighbouring hulls, which proves that they are disjoint:
///
///       .---.          q . ' .---.        a is on the left of the line pq, b is on the right.
///      (  a  )     . '  (   b   )         It is certified with the four edges that end at p and q
///       '---' p '        '-----'          (figure 3.1 of the thesis, C and D).
///
struct SeparatingTangent {
  ClusterId a = -1;  ///< -1: there is none of this id
  ClusterId b = -1;
  PointId p = -1;
  PointId q = -1;
};

/// The separating tangents of those pairs of hulls that are neighbours: the scene says which. Hulls
/// that are no neighbours need no proof.
class SeparatingTangents {
 public:
  /// Requires: both outlive it.
  SeparatingTangents(CertificateQueue& queue, const KineticHulls& hulls)
      : queue_(queue), hulls_(hulls) {}

  void AddCluster() { of_cluster_.emplace_back(); }
  [[nodiscard]] const SeparatingTangent& tangent(TangentId t) const { return tangents_[Index(t)]; }
  [[nodiscard]] std::span<const TangentId> Of(ClusterId c) const { return of_cluster_[Index(c)]; }
  [[nodiscard]] bool Exists(ClusterId a, ClusterId b) const;
  /// How many there are.
  [[nodiscard]] std::int64_t count() const {
    return static_cast<std::int64_t>(tangents_.size() - free_.size());
  }

  /// Makes the one of two hulls. Requires: they are disjoint just after now, and have none.
  void Make(ClusterId a, ClusterId b);
  void DropAllOf(ClusterId c);
  /// Moves both ends to where the line separates the hulls and certifies it. False, and nothing is
  /// certified, where the hulls intersect just after now. Cost: O(h) for h corners on the way.
  [[nodiscard]] bool Restore(TangentId t);

  /// Throws InternalError where the line does not separate the hulls just after now.
  void CheckTangent(TangentId t) const;

 private:
  [[nodiscard]] int StepAt(PointId own, PointId other) const;
  [[nodiscard]] bool Walk(SeparatingTangent& tangent) const;
  void Certify(TangentId t);

  CertificateQueue& queue_;
  const KineticHulls& hulls_;
  std::vector<SeparatingTangent> tangents_;
  std::vector<TangentId> free_;
  std::vector<std::vector<TangentId>> of_cluster_;
};

}  // namespace farhorizon::kinetic

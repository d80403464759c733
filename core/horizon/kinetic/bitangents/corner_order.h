#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/horizon/kinetic/bitangents/tangent_certificates.h"
#include "core/horizon/kinetic/bitangents/tangent_table.h"
#include "core/horizon/kinetic/hulls/kinetic_hulls.h"
#include "core/horizon/kinetic/hulls/moving_point.h"
#include "core/horizon/kinetic/hulls/step_marks.h"

namespace farhorizon::kinetic {

/// What is known at a corner of a hull. Empty at points that are no corners.
struct Corner {
  int depth = 0;            ///< how many hulls occlude the line of the corner's first edge
  bool on_horizon = false;  ///< a visual gap of positive width was here at some depth
  std::vector<HalfTangentId> half_tangents;      ///< all of the corner, in any order
  std::vector<HalfTangentId> active_bitangents;  ///< the active ones, in order of direction
};

/// The half tangents at each corner in order of direction, which of them are active, and the visual
/// gaps between those: the two levels of the thesis's search trees [Archambault03, section 3.2.5].
///
/// The lines that touch a hull at corner p, directed with the hull on their left, turn from the
/// edge (prev, p) to the edge (p, next). At a half tangent that starts, one more hull begins to
/// occlude them; at one that ends, one fewer does:
///
///     edge    a       b       c       d       e       f       edge
///     prev,p  starts  ends    starts  starts  ends    ends    p,next
///       |       |       |       |       |       |       |       |
///       |   0   |   1   |   0   |   1   |   2   |   1   |   0   |    depth
///       | visual|occlud.| visual|       occluded        | visual|
///       | gap 0 | gap 1 | gap 2 |         gap 3         | gap 4 |
///            active  active  active                  active
///
/// A half tangent is *active* if the lines on one side of it are visual lines, occluded by no hull
/// (lemma 3.2 of the thesis). The active ones and the two edges of the hull bound the *gaps*,
/// visual and occluded in turn; gap i is the one before active bitangent i. All half tangents
/// inside occluded gaps are inactive, and none are inside visual ones. If the depth at the first
/// edge is 0, the first gap is visual. A gap between two half tangents in line has no width.
///
/// Certificates (tangent_certificates.h): an active half tangent has its neighbours in
/// active_bitangents, or an edge of the hull, as its partners. An inactive one has the border of
/// its gap (an active one, or an edge), the four kinds of figure 3.1 of the thesis, or another
/// inactive one that is nearer to that border. Inactive ones have no other order.
///
/// All this holds at corners that are not stale (step_marks.h).
class CornerOrder {
 public:
  /// Requires: all outlive it.
  CornerOrder(const KineticHulls& hulls, const TangentTable& tangents,
              TangentCertificates& certificates, StepMarks& marks)
      : hulls_(hulls), tangents_(tangents), certificates_(certificates), marks_(marks) {}

  void AddPoint() { corners_.emplace_back(); }
  /// Makes room for all of the table's tangents.
  void Resize() { active_.resize(Index(tangents_.half_count()), false); }

  [[nodiscard]] const Corner& corner(PointId p) const { return corners_[Index(p)]; }
  [[nodiscard]] bool IsActive(HalfTangentId half) const { return active_[Index(half)]; }
  /// How many of the active bitangents at its corner are before the half tangent: its gap, too.
  [[nodiscard]] std::size_t ActiveBefore(HalfTangentId half) const;
  /// The active bitangent of that index; kHullEdge where there is none, as before the first.
  [[nodiscard]] HalfTangentId ActiveOrEdge(PointId p, std::size_t index) const;
  [[nodiscard]] bool IsVisualGap(PointId p, std::size_t gap) const {
    return (corner(p).depth == 0) == (gap % 2 == 0);
  }

  void AddToDepth(PointId p, int change) { corners_[Index(p)].depth += change; }
  /// Adds a half tangent that has come to its corner. The order is stale then, or is put right by
  /// the caller.
  void Insert(HalfTangentId half) {
    corners_[Index(tangents_.Own(half))].half_tangents.push_back(half);
  }
  /// Takes a half tangent from the corner; those that deferred to it get the border of their gap.
  void Remove(PointId p, HalfTangentId half);
  void RemoveAll(PointId p);
  void Deactivate(HalfTangentId half) { active_[Index(half)] = false; }
  /// Occludes all lines between two new half tangents at the corner, or an edge of the hull. The
  /// depth is still that of before. Does nothing at a stale corner.
  void Occlude(PointId p, HalfTangentId from, HalfTangentId to);
  /// Replaces active bitangents [begin, end) by `inserted`; certificates are left to the caller.
  void ReplaceActive(PointId p, std::size_t begin, std::size_t end,
                     std::span<const HalfTangentId> inserted);
  /// Certifies the active bitangent of that index with its neighbours, if there is one.
  void CertifyActive(PointId p, std::size_t index);
  /// Certifies an inactive half tangent with the border of its gap.
  void CertifyWithGap(HalfTangentId half, std::size_t which);
  /// All certificates of a half tangent and of those that defer to it, after its other end has
  /// moved.
  void CertifyAgain(HalfTangentId half);
  /// Finds activities, certificates and visual gaps of a corner anew, from its depth and its half
  /// tangents alone. Cost: O(k log n), k half tangents, n certificates.
  void Rebuild(PointId p);
  /// Records that the gap between two neighbours, or edges of the hull, is visual.
  void NoteVisualGap(PointId p, HalfTangentId before, HalfTangentId after);

  using Aimed = std::pair<Aim, HalfTangentId>;
  /// Sorts the half tangents of a corner. Returns them with their directions; valid until the next
  /// call.
  std::span<const Aimed> Sort(PointId p);

  /// Throws InternalError where an invariant does not hold at a corner.
  void CheckCorner(PointId p) const;
  /// Throws InternalError where the half tangent is not listed at its corner, once.
  void CheckListed(HalfTangentId half) const;

 private:
  void FindActive(PointId p);
  void CertifyOnceMore(HalfTangentId half, std::size_t which);
  void CheckPartners(HalfTangentId half, std::size_t which) const;

  const KineticHulls& hulls_;
  const TangentTable& tangents_;
  TangentCertificates& certificates_;
  StepMarks& marks_;
  std::vector<Corner> corners_;  // by point
  std::vector<bool> active_;     // by half tangent
  std::vector<Aimed> aimed_;     // of the last Sort()
};

}  // namespace farhorizon::kinetic

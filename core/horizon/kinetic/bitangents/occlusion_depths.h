#pragma once

#include <utility>
#include <vector>

#include "core/horizon/kinetic/bitangents/corner_order.h"
#include "core/horizon/kinetic/bitangents/tangent_table.h"
#include "core/horizon/kinetic/hulls/kinetic_hulls.h"
#include "core/horizon/kinetic/hulls/step_marks.h"

namespace farhorizon::kinetic {

/// The depth of each corner: how many hulls occlude the line of its first edge, the one from the
/// previous corner. Each other hull occludes two arcs (tangent_table.h), and with an arc the first
/// edges of the corners after its start up to its end:
///
///        start         end
///          |            |          The depths of q, r and s count the hull: it occludes the lines
///      ----p---q----r---s----      pq, qr and rs. At p it occludes those between the start and pq,
///                                  at s those between rs and the end: CornerOrder has these.
///
/// While a hull is marked for a recount (step_marks.h), its depths have no meaning, until
/// Recount().
class OcclusionDepths {
 public:
  /// Requires: all outlive it.
  OcclusionDepths(const KineticHulls& hulls, const TangentTable& tangents, CornerOrder& order,
                  StepMarks& marks)
      : hulls_(hulls), tangents_(tangents), order_(order), marks_(marks) {}

  /// Occludes the lines of a new arc [Archambault03, lemma 3.5]: where there were visual lines, the
  /// active bitangents inside become inactive. Cost: O(h + log k), h corners on the way.
  void Occlude(const Arc& arc);
  /// Remembers an arc whose tangents are about to be dropped.
  void Drop(const Arc& arc);
  /// Takes the dropped arcs out of the depths. Requires: the hulls into which the occluding ones
  /// were joined have their tangents; they occlude all of the arcs. So no depth falls to 0 between.
  void ReleaseDropped();
  /// Counts all depths of a hull anew; corners at which visual lines may have begun or ended are
  /// marked stale. Cost: O(h + k).
  void Recount(ClusterId c);

 private:
  const KineticHulls& hulls_;
  const TangentTable& tangents_;
  CornerOrder& order_;
  StepMarks& marks_;
  std::vector<std::pair<PointId, PointId>> dropped_;  // corners at which arcs started and ended
  std::vector<int> changes_;                          // of Recount()
};

}  // namespace farhorizon::kinetic

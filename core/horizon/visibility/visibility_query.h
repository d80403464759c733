#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/exact/predicate_counts.h"
#include "core/geometry/segment.h"
#include "core/horizon/visibility/face_wedge.h"
#include "core/horizon/visibility/ties.h"
#include "core/horizon/witness.h"

namespace farhorizon {

class SegmentIndex;

/// A member of an OccluderSet.
using OccluderId = std::int32_t;

/// What is known beforehand about the segment of a query. Hints save time. They never change
/// whether a line of sight exists, but another one may be found.
struct OcclusionHints {
  /// Segments that do not rise above the set's H (core/horizon/README.md, corollary 2a), each with
  /// its lower end first.
  std::span<const Segment> virtual_occluders = {};
  /// Members that are tried before all others: those that occlude a neighbour of the segment, as a
  /// rule.
  std::span<const OccluderId> likely = {};
  /// Directions that the ground beside the segment leaves free. That ground must not rise above the
  /// set's H.
  std::optional<FaceWedge> wedge = std::nullopt;
};

/// Asks whether a segment is visible over the members of an OccluderSet.
struct VisibilityQuery {
  Segment segment = {};
  Ties ties = Ties::kPass;
  std::optional<OccluderId> except = std::nullopt;  ///< a member to ignore: often the segment
  OcclusionHints hints = {};
  /// The most decisions, as PredicateCounts counts them, before the search gives up; one occluder
  /// more is decided at most.
  std::optional<std::int64_t> decision_limit = std::nullopt;
  bool want_occluders = false;  ///< whether Visibility::occluders is filled
};

/// The answer to a VisibilityQuery.
struct Visibility {
  /// A line of sight that touches the segment; nullopt: there is none, or the search gave up.
  std::optional<Witness> witness = std::nullopt;
  /// Where asked for and `witness` is empty: members that occlude the segment together with the
  /// hints; where the search gave up, those that occlude the part of it that was decided. In no
  /// order, with repetitions.
  std::vector<OccluderId> occluders = {};
  bool gave_up = false;  ///< the decision limit ended the search: an empty `witness` proves nothing
  PredicateCounts counts = {};  ///< the decisions that the search took
};

/// Answers a query about the members of an index: OccluderSet::FindLineOfSight, which says what
/// the answer is.
Visibility FindLineOfSight(const SegmentIndex& segments, const VisibilityQuery& query);

}  // namespace farhorizon

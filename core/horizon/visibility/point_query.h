#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/exact/quadratic.h"
#include "core/horizon/visibility/occluded_range.h"
#include "core/horizon/visibility/point_view.h"
#include "core/horizon/visibility/segment_index.h"
#include "core/horizon/visibility/target_segment.h"
#include "core/horizon/visibility/visibility_query.h"

namespace farhorizon {

/// What is known of one point of a segment: a witness, or the range around it that is occluded.
struct PointAnswer {
  std::optional<Witness> witness = std::nullopt;
  /// Where there is a witness: about the middle of the widest free arc, in columns and rows.
  std::array<double, 2> free_direction = {};
  OccludedRange occluded = {};  ///< where there is none
  bool gave_up = false;         ///< the query's decision limit was reached: neither has a meaning
};

/// Asks points of one segment whether they are visible over the members of an index, each in the
/// smallest numbers that suffice. Occluders of one point are tried first at the next.
class PointQuery {
 public:
  /// Of the query, want_occluders does not matter here; decision_limit is for all points together.
  /// Requires: both outlive this.
  PointQuery(const SegmentIndex& index, const VisibilityQuery& query);
  PointQuery(const PointQuery&) = delete;
  PointQuery& operator=(const PointQuery&) = delete;

  /// t: along the TargetSegment, from the segment's lower end; in [0, 1]. Exact.
  PointAnswer AnswerAt(const WideDyadic& t);

  /// The members whose arcs cover all directions at the point that was asked last; empty where it
  /// is visible. Virtual occluders and the ground beside the segment are left out.
  [[nodiscard]] const std::vector<OccluderId>& occluders() const { return occluders_; }

  /// All decisions so far.
  [[nodiscard]] const PredicateCounts& counts() const { return counts_; }

  /// Whether a double can hold the t of a witness at `t`.
  [[nodiscard]] bool FitsDouble(const WideDyadic& t) const;

 private:
  template <typename Int>
  PointAnswer AnswerFrom(BasicPointView<Int>& view, const BasicDyadic<Int>& t);

  const SegmentIndex& index_;
  const VisibilityQuery& query_;
  bool from_high_;  // the segment's first end is the higher one
  TargetSegment target_;
  PredicateCounts counts_;
  ShortPointView short_view_;
  std::vector<OccluderId> likely_;
  std::vector<OccluderId> occluders_;
};

/// Whether the witness is exact and its direction is of integers that every JSON reader holds:
/// below 2^53.
bool IsPlain(const Witness& witness);
/// Whether `a` is exact and `b` is not, or, where that is equal, has a direction of fewer bits.
bool IsSimpler(const Witness& a, const Witness& b);

}  // namespace farhorizon

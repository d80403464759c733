#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/exact/quadratic.h"
#include "core/horizon/visibility/occluded_range.h"
#include "core/horizon/visibility/occluder_set.h"
#include "core/horizon/visibility/point_view.h"
#include "core/horizon/visibility/segment_index.h"

namespace farhorizon {

/// What one point of a segment told: a sight, or a range around it that is hidden.
struct PointAnswer {
  std::optional<Witness> sight;
  /// The middle of the free directions around the sight, about: columns and rows.
  std::array<double, 2> middle = {};
  OccludedRange hidden;
};

/// Asks points of one segment whether they can be sighted over the members of an index, in the numbers
/// that each needs. What hid one point is tried first at the next.
class PointQuery {
 public:
  /// except, hints, blockers, counts: as OccluderSet::FindLineOfSight. All of them must outlive the search.
  PointQuery(const SegmentIndex& index, const Segment& segment, Ties ties,
             std::optional<std::int32_t> except, const OcclusionHints& hints,
             std::vector<std::int32_t>* blockers, PredicateCounts* counts);
  PointQuery(const PointQuery&) = delete;
  PointQuery& operator=(const PointQuery&) = delete;

  /// t: as TargetSegment counts it, from the lower end; in [0, 1]. Exact.
  PointAnswer LookAt(const WideDyadic& t);

  /// Whether a witness at t can be said in a double.
  [[nodiscard]] bool FitsDouble(const WideDyadic& t) const;

 private:
  template <typename Int>
  PointAnswer LookWith(BasicPointView<Int>& sample, const BasicDyadic<Int>& t);

  const SegmentIndex& index_;
  bool from_high_;  // the lower end is the segment's second
  TargetSegment target_;
  std::optional<std::int32_t> except_;
  const OcclusionHints& hints_;
  std::vector<std::int32_t> likely_;
  std::vector<std::int32_t> chain_;
  std::vector<std::int32_t>* blockers_;
  PredicateCounts* counts_;
  ShortPointView short_sample_;
};

/// Whether a double and two integers that others' JSON reads exactly say it all.
bool IsPlain(const Witness& witness);
/// Whether a says its line in fewer digits.
bool Simpler(const Witness& a, const Witness& b);

}  // namespace farhorizon

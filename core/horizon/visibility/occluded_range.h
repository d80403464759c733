#pragma once

#include <cstdint>
#include <vector>

#include "core/exact/quadratic.h"
#include "core/horizon/visibility/point_view.h"

namespace farhorizon {

/// Positions of a segment that are proven hidden: all t in [from, to], both in [0, 1].
struct OccludedRange {
  QuadraticRoot from;
  QuadraticRoot to;
};

/// How far along the segment the same obstacles, in the same order, go on hiding every direction.
///
/// The arcs that `sample` found complete at t are thinned to a chain around the half turn; the
/// chain holds as long as each arc turns the right way, each begins before the one before it ends,
/// and each obstacle goes on rising through or above the point: signs of quadratics in t. Exact.
/// blockers: where not null, the members among the chain's obstacles are appended.
template <typename Int>
OccludedRange OccludedRangeAround(const TargetSegment& target, const BasicPointView<Int>& sample,
                                  PointOutcome outcome, const BasicDyadic<Int>& at,
                                  std::vector<std::int32_t>* blockers, PredicateCounts* counts);

}  // namespace farhorizon

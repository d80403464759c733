#pragma once

#include <vector>

#include "core/exact/quadratic.h"
#include "core/horizon/visibility/point_view.h"

namespace farhorizon {

/// Positions along a target: all t in [from, to], both in [0, 1].
struct OccludedRange {
  QuadraticRoot from;
  QuadraticRoot to;
};

/// The range of t around view.t() on which the same occluders, in the same order, go on covering
/// all directions (core/horizon/README.md, theorem 9): every position in it is occluded. It is the
/// one position where the outcome is kAmbiguous. Exact.
///
/// occluders: the members among these occluders are appended, virtual ones and faces left out.
/// Requires: view.outcome() is not kVisible.
template <typename Int>
OccludedRange OccludedRangeAround(const BasicPointView<Int>& view,
                                  std::vector<OccluderId>& occluders);

}  // namespace farhorizon

#pragma once

#include "core/geometry/point.h"
#include "core/horizon/visibility/moving_vector.h"
#include "core/horizon/visibility/ties.h"

namespace farhorizon {

/// The segment whose visibility is asked, from its lower end (t = 0) to its higher end (t = 1).
struct TargetSegment {
  Point3i low;
  Point3i high;
  Ties ties = Ties::kPass;

  [[nodiscard]] bool IsHorizontal() const { return low.z == high.z; }
};

/// From the point of the target at t to `v`, in the plan.
MovingVector ToPoint(const TargetSegment& target, const Point3i& v);

/// From the point of the target at t to the slice point of the segment low -> high, times
/// high.z - low.z. The slice point is where the line through low and high passes the height of the
/// target at t. Requires: low.z < high.z.
MovingVector ToSlice(const TargetSegment& target, const Point3i& low, const Point3i& high);

}  // namespace farhorizon

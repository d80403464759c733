#include "core/horizon/visibility/target_segment.h"

#include <cstdint>

namespace farhorizon {

MovingVector ToPoint(const TargetSegment& target, const Point3i& v) {
  return {v.x - target.low.x, v.y - target.low.y, target.low.x - target.high.x,
          target.low.y - target.high.y};
}

MovingVector ToSlice(const TargetSegment& target, const Point3i& low, const Point3i& high) {
  const Point3i& from = target.low;
  const Point3i& to = target.high;
  const std::int64_t rise = std::int64_t{high.z} - low.z;
  const std::int64_t below = std::int64_t{from.z} - low.z;
  const std::int64_t climb = std::int64_t{to.z} - from.z;
  const std::int64_t run_x = high.x - low.x;
  const std::int64_t run_y = high.y - low.y;
  return {(low.x - from.x) * rise + run_x * below, (low.y - from.y) * rise + run_y * below,
          (from.x - to.x) * rise + run_x * climb, (from.y - to.y) * rise + run_y * climb};
}

}  // namespace farhorizon

#pragma once

#include <cstdint>

#include "core/horizon/kinetic/hulls/moving_point.h"
#include "core/horizon/kinetic/hulls/step_marks.h"

namespace farhorizon::kinetic {

struct KineticPoint {
  MovingPoint path;
  std::int64_t end = 0;    ///< the depth at which it is removed
  std::int32_t tag = 0;    ///< the caller's
  ClusterId cluster = -1;  ///< the one that it was last found in; ClusterOf() has the present one
  bool alive = true;       ///< may still become a corner, or is one
  bool corner = false;     ///< of the hull of its cluster
  /// Of a corner: the previous and the next one, counter-clockwise, and its place among the corners
  /// of its cluster. Of a point that was a corner: what they were then; else -1, -1 and 0.
  PointId prev = -1;
  PointId next = -1;
  std::int32_t index = 0;
};

}  // namespace farhorizon::kinetic

#pragma once

#include <cmath>

#include "core/geometry/vector.h"

namespace farhorizon {

/// A vector of the plan, columns and rows, that moves with t: (ax, ay) + t (bx, by).
struct PlanMotion {
  double ax = 0;
  double ay = 0;
  double bx = 0;
  double by = 0;

  [[nodiscard]] PlanVector At(double t) const { return {ax + t * bx, ay + t * by}; }
};

/// The angle from one direction to another that is less than half a turn counter-clockwise of it,
/// or its opposite, from their dot and cross product; radians, 0 to pi. A cross product that
/// rounding has made negative counts as 0, and so does -0: the opposite is at pi, never at -pi.
inline double HalfTurnAngle(double dot, double cross) {
  return std::atan2(cross > 0 ? cross : 0.0, dot);
}

}  // namespace farhorizon

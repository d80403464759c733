#pragma once

#include "core/exact/wide.h"
#include "core/horizon/skyline.h"

namespace farhorizon {

/// An exact vector in the plan.
struct Vector {
  Int128 x = 0;
  Int128 y = 0;

  [[nodiscard]] bool IsZero() const { return x == 0 && y == 0; }
  Vector operator-() const { return {-x, -y}; }
};

/// The sign of the cross product: 1 where b is counter-clockwise of a within half a turn.
int CrossSign(const Vector& a, const Vector& b);
/// The sign of the dot product.
int DotSign(const Vector& a, const Vector& b);

/// A direction of sight: a vector without sense, stored as the one of the two that lies in the
/// upper half plane, [0, 180) degrees from the x axis. Ordered by that angle.
struct Direction {
  Vector v;
  double key = 0;       ///< 1 - cos-like, rising with the angle from 0 to 2; error below 2^-50
  bool turned = false;  ///< v is the opposite of what it was made from
};

/// Requires: `v` is not zero.
Direction MakeDirection(const Vector& v);

/// The two ends of the half turn: the first direction and the same again after half a turn.
Direction FirstDirection();
Direction LastDirection();

/// -1, 0, 1 as the angle of a is less than, the same as, greater than that of b. Exact; the keys
/// decide where they are apart by more than their error.
int CompareAngle(const Direction& a, const Direction& b, PredicateCounts* counts);

/// The integer vector of least size strictly between from and to, going counter-clockwise, that is
/// not parallel to `along`. Requires: cross(from, to) > 0, or from = -to.
Vector SimplestBetween(const Vector& from, const Vector& to, const Vector& along);

}  // namespace farhorizon

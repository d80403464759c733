#pragma once

#include <cstdint>
#include <optional>

#include "core/horizon/kinetic/hulls/sweep_depth.h"
#include "core/terrain/terrain.h"

namespace farhorizon::kinetic {

/// A point of the plan that moves on a straight line while the sweep plane falls: at depth s it is
/// at ((x + vx s) / d, (y + vy s) / d). d > 0.
struct MovingPoint {
  std::int64_t x = 0;
  std::int64_t vx = 0;
  std::int64_t y = 0;
  std::int64_t vy = 0;
  std::int64_t d = 1;

  /// A post, which does not move.
  static MovingPoint Standing(std::int64_t x, std::int64_t y) { return {x, 0, y, 0, 1}; }
  /// Where the plane cuts the edge from `high` down to `low`. summit: height at s = 0.
  static MovingPoint Sliding(Point3i high, Point3i low, std::int64_t summit);
  /// Where this one is at depth s, standing there.
  [[nodiscard]] MovingPoint At(std::int64_t s) const { return {x + vx * s, 0, y + vy * s, 0, d}; }
};

/// A polynomial with the sign of the orientation of a, b, c: positive where c is left of ab.
Quadratic Orientation(const MovingPoint& a, const MovingPoint& b, const MovingPoint& c);

/// The sign of that orientation just after `now`; 0 only where they stay in line for ever. Exact.
int OrientAfter(const MovingPoint& a, const MovingPoint& b, const MovingPoint& c,
                const SweepDepth& now);

/// The sign of that orientation at a whole depth. Exact.
int OrientAt(const MovingPoint& a, const MovingPoint& b, const MovingPoint& c, std::int64_t s);

/// Three points whose orientation is certified.
struct PointTriple {
  const MovingPoint& a;
  const MovingPoint& b;
  const MovingPoint& c;
};
/// The first depth strictly between now and end at which sign times the orientation becomes
/// negative; nullopt if there is none. Requires: it is not negative just after now.
std::optional<SweepDepth> TurnFailureAfter(const PointTriple& points, int sign,
                                           const SweepDepth& now, std::int64_t end);

/// A direction in floating point, with a bound on its error: |x| + |y| = 1 nearly, and each of them
/// is off by `error` at most. An error of 1 says that nothing is known.
struct Aim {
  double x = 0;
  double y = 0;
  double error = 0;
};
/// The direction from one point to the other just after `now`.
Aim AimAt(const MovingPoint& from, const MovingPoint& to, const SweepDepth& now);
/// The sign of the cross product of a and b if floating point is sure of it, else 0. As |x| + |y|
/// is 1 of both, and their errors are 1/2 at most or 1, the product is off by less than twice the
/// sum of the errors; the constant pays for its own rounding.
inline int FilteredCrossSign(const Aim& a, const Aim& b) {
  const double value = a.x * b.y - a.y * b.x;
  const double error = 2 * (a.error + b.error) + 0x1p-50;
  return value > error ? 1 : value < -error ? -1 : 0;
}

/// The order of a and b by x, then y, just after `now`: -1, 0, 1. Exact.
int OrderAfter(const MovingPoint& a, const MovingPoint& b, const SweepDepth& now);

}  // namespace farhorizon::kinetic

#pragma once

#include <cstdint>
#include <optional>

#include "core/horizon/kinetic/moment.h"
#include "core/terrain/terrain.h"

namespace farhorizon::kinetic {

/// A point of the plan that moves with the depth s: ((x + vx s) / d, (y + vy s) / d). d > 0.
struct MovingPoint {
  std::int64_t x = 0;
  std::int64_t vx = 0;
  std::int64_t y = 0;
  std::int64_t vy = 0;
  std::int64_t d = 1;

  /// A post, which stays.
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
                const Moment& now);

/// The sign of that orientation at a whole depth. Exact.
int OrientAt(const MovingPoint& a, const MovingPoint& b, const MovingPoint& c, std::int64_t s);

/// The first moment strictly between now and end at which sign times that orientation becomes negative.
/// Requires: it is not negative just after now.
std::optional<Moment> TurnAfter(const MovingPoint& a, const MovingPoint& b, const MovingPoint& c,
                                int sign, const Moment& now, std::int64_t end);

/// A direction whose coordinates' sizes add up to 1, each off by `error` at most.
struct Aim {
  double x = 0;
  double y = 0;
  double error = 0;
};
/// Where `to` is seen from `from` just after `now`.
Aim AimAt(const MovingPoint& from, const MovingPoint& to, const Moment& now);
/// The sign of the cross product of a and b if it is sure, else 0.
inline int TurnOf(const Aim& a, const Aim& b) {
  const double value = a.x * b.y - a.y * b.x;
  const double error = 2 * (a.error + b.error) + 0x1p-50;
  return value > error ? 1 : value < -error ? -1 : 0;
}

/// The order of a and b by x, then y, just after `now`: -1, 0, 1. Exact.
int OrderAfter(const MovingPoint& a, const MovingPoint& b, const Moment& now);

}  // namespace farhorizon::kinetic

#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "core/exact/quadratic.h"

namespace farhorizon::kinetic {

/// How far the plane has sunk below the summit: a whole number of quanta, or a root of a polynomial in
/// that depth. lo <= the number <= hi.
struct Moment {
  bool whole = true;
  bool upper = false;  ///< which root of q, as in QuadraticRoot
  std::int64_t s = 0;
  Quadratic q = {};
  double lo = 0;
  double hi = 0;

  static Moment At(std::int64_t s);
};

/// The sign of a - b, exactly. Requires: |c2| < 2^36, |c1| < 2^84, |c0| < 2^124, |s| < 2^32.
int Compare(const Moment& a, const Moment& b);

/// The real roots of q by rising size; `twofold`: one, at which q does not change its sign.
struct Roots {
  int count = 0;
  bool twofold = false;
  std::array<Moment, 2> at;
};
Roots RootsOf(const Quadratic& q);

/// The sign of q just after `now`; 0 only where q is zero everywhere. Exact.
int SignAfter(const Quadratic& q, const Moment& now);

/// The first moment strictly between now and end at which q becomes negative.
/// Requires: SignAfter(q, now) >= 0.
std::optional<Moment> FailureAfter(const Quadratic& q, const Moment& now, std::int64_t end);

}  // namespace farhorizon::kinetic

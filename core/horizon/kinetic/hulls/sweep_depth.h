#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "core/exact/quadratic.h"

namespace farhorizon::kinetic {

/// How far the sweep plane is below the summit: a whole number of quanta, or a root of a polynomial
/// in that depth, where a certificate fails. The letter `s` is a whole depth everywhere in this
/// folder.
struct SweepDepth {
  bool whole = true;
  bool upper = false;  ///< which root of q, as in QuadraticRoot
  std::int64_t s = 0;  ///< where whole
  Quadratic q = {};    ///< where not whole
  double lo = 0;       ///< lo <= the depth <= hi
  double hi = 0;

  static SweepDepth At(std::int64_t s);
};

/// A depth below all terrain.
inline constexpr std::int64_t kNever = std::int64_t{1} << 31;

/// The sign of a - b. Exact. Requires: |c2| < 2^36, |c1| < 2^84, |c0| < 2^124, |s| < 2^32.
int Compare(const SweepDepth& a, const SweepDepth& b);

/// The real roots of q in ascending order; `twofold`: one, at which q does not change its sign.
struct Roots {
  int count = 0;
  bool twofold = false;
  std::array<SweepDepth, 2> at;
};
Roots RootsOf(const Quadratic& q);

/// The sign of q just after `now`; 0 only where q is zero everywhere. Exact.
int SignAfter(const Quadratic& q, const SweepDepth& now);

/// The first depth strictly between now and end at which q becomes negative; nullopt if there is
/// none.
/// Requires: SignAfter(q, now) >= 0.
std::optional<SweepDepth> FailureAfter(const Quadratic& q, const SweepDepth& now, std::int64_t end);

}  // namespace farhorizon::kinetic

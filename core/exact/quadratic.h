#pragma once

#include <optional>

#include "core/exact/wide.h"

namespace farhorizon {

/// n / 2^k, with 0 <= n <= 2^k and k <= kMaxDyadicBits.
struct Dyadic {
  Int128 n = 0;
  int k = 0;

  [[nodiscard]] double ToDouble() const;
};
inline constexpr int kMaxDyadicBits = 70;

/// c0 + c1 t + c2 t^2. Requires: |c| < 2^104.
struct Quadratic {
  Int128 c0 = 0;
  Int128 c1 = 0;
  Int128 c2 = 0;

  [[nodiscard]] bool IsZero() const { return c0 == 0 && c1 == 0 && c2 == 0; }
};

/// The sign of q at t, exactly.
int SignAt(const Quadratic& q, Dyadic t);

/// True only if q >= 0 on all of [0, 1] (its Bernstein coefficients are). Cheap; misses some.
inline bool PlainlyNonNegative(const Quadratic& q) {
  return q.c0 >= 0 && 2 * q.c0 + q.c1 >= 0 && q.c0 + q.c1 + q.c2 >= 0;
}

/// A real root of a polynomial that is not constant: the lower or the upper of two, or the only
/// one.
struct QuadraticRoot {
  Quadratic q;
  bool upper = false;

  /// The number itself, as the root of 2^k t - n.
  static QuadraticRoot At(Dyadic t);
};

/// The sign of root - t, exactly. Requires: the root is real.
int Compare(const QuadraticRoot& root, Dyadic t);

/// The sign of r - s, exactly: by bisection, and where that does not part them by the resultant.
/// Requires: both in [0, 1].
int Compare(const QuadraticRoot& r, const QuadraticRoot& s);

/// The coarsest dyadic number strictly between; nullopt where lo >= hi. Requires: both in [0, 1].
std::optional<Dyadic> Between(const QuadraticRoot& lo, const QuadraticRoot& hi);

/// The largest closed interval around t on which q >= 0; an end that is missing is at infinity.
/// point: the interval is t alone.
struct NonNegativeRange {
  bool point = false;
  std::optional<QuadraticRoot> from;
  std::optional<QuadraticRoot> to;
};
/// Requires: q(t) >= 0.
NonNegativeRange NonNegativeAround(const Quadratic& q, Dyadic t);

}  // namespace farhorizon

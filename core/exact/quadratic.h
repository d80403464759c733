#pragma once

#include <cmath>
#include <cstdint>
#include <optional>

#include "core/exact/int128.h"
#include "core/exact/int1280.h"

namespace farhorizon {

/// n / 2^k, with 0 <= n <= 2^k.
template <typename Int>
struct BasicDyadic {
  Int n{};
  int k = 0;

  [[nodiscard]] double ToDouble() const { return std::ldexp(static_cast<double>(n), -k); }
};

/// k <= kMaxDyadicBits: nearly all that are ever asked for.
using Dyadic = BasicDyadic<Int128>;
inline constexpr int kMaxDyadicBits = 70;

/// The few bits that most points need.
using ShortDyadic = BasicDyadic<std::int64_t>;

/// k <= kMaxWideDyadicBits: one of these is between any two different roots in [0, 1]. For two roots
/// a and b of polynomials p and q without a common one, with the other roots a' and b', the resultant
/// p2^2 q2^2 (a - b)(a - b')(a' - b)(a' - b') is an integer, not 0. |p2 a'| = |p1 + p2 a| < 2^105,
/// so |p2 (a' - b)| and |q2 (a - b')| are below 2^106, |p2 q2 (a' - b')| below 2^210, and |a - b| is
/// above 2^-422. Roots of polynomials that share one are rational, or of one polynomial, and further
/// apart.
using WideDyadic = BasicDyadic<Int1280>;
inline constexpr int kMaxWideDyadicBits = 424;

WideDyadic Widened(Dyadic t);
/// Requires: t.k <= kMaxDyadicBits.
Dyadic Narrowed(const WideDyadic& t);

/// c0 + c1 t + c2 t^2. Requires: |c| < 2^104.
struct Quadratic {
  Int128 c0 = 0;
  Int128 c1 = 0;
  Int128 c2 = 0;

  [[nodiscard]] bool IsZero() const { return c0 == 0 && c1 == 0 && c2 == 0; }
};

/// The sign of q at t, exactly.
int SignAt(const Quadratic& q, Dyadic t);
int SignAt(const Quadratic& q, const WideDyadic& t);

/// True only if q >= 0 on all of [0, 1] (its Bernstein coefficients are). Cheap; misses some.
inline bool BernsteinNonNegative(const Quadratic& q) {
  return q.c0 >= 0 && 2 * q.c0 + q.c1 >= 0 && q.c0 + q.c1 + q.c2 >= 0;
}

/// A real root of a polynomial that is not constant: the lower or the upper of two, or the only
/// one.
struct QuadraticRoot {
  Quadratic q;
  bool upper = false;

  /// The number itself, as the root of 2^k t - n. Requires: k <= 103; so it is for every number at
  /// which a Quadratic is 0 that is not so everywhere: 2^k divides one of its coefficients.
  static QuadraticRoot At(Dyadic t);
  static QuadraticRoot At(const WideDyadic& t);
};

/// The sign of root - t, exactly. Requires: the root is real.
int Compare(const QuadraticRoot& root, Dyadic t);
int Compare(const QuadraticRoot& root, const WideDyadic& t);

/// The sign of r - s, exactly: by doubles, by bisection, and where that does not part them by the
/// resultant.
/// Requires: both in [0, 1].
int Compare(const QuadraticRoot& r, const QuadraticRoot& s);

/// The coarsest dyadic number strictly between; nullopt where lo >= hi. Requires: both in [0, 1].
std::optional<WideDyadic> Between(const QuadraticRoot& lo, const QuadraticRoot& hi);

/// The largest closed interval around t on which q >= 0; an end that is missing is at infinity.
/// point: the interval is t alone.
struct NonNegativeRange {
  bool point = false;
  std::optional<QuadraticRoot> from;
  std::optional<QuadraticRoot> to;
};
/// Requires: q(t) >= 0.
NonNegativeRange NonNegativeAround(const Quadratic& q, Dyadic t);
NonNegativeRange NonNegativeAround(const Quadratic& q, const WideDyadic& t);

}  // namespace farhorizon

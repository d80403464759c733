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

  /// Within 2^-52 of the number; exact where n has at most 53 bits.
  [[nodiscard]] double ToDouble() const { return std::ldexp(static_cast<double>(n), -k); }
};

/// k <= kMaxDyadicBits: enough for nearly all points that are evaluated.
using Dyadic = BasicDyadic<Int128>;
inline constexpr int kMaxDyadicBits = 70;

/// For the few bits that most points need.
using ShortDyadic = BasicDyadic<std::int64_t>;

/// k <= kMaxWideDyadicBits.
///
/// One of these numbers lies between any two different roots a, b in [0, 1] of Quadratics p, q.
/// Where p and q have no root in common, let a' and b' be their other roots. The resultant
///   p2^2 q2^2 (a - b)(a - b')(a' - b)(a' - b')
/// is an integer other than 0, and a - b is its only factor that can be small:
///   |p2 a'| = |p1 + p2 a| < 2^105, and |q2 b'| < 2^105 alike, so
///   |p2 (a' - b)| < 2^106, |q2 (a - b')| < 2^106, |p2 q2 (a' - b')| < 2^210.
/// The product of these three is below 2^422, so |a - b| > 2^-422. Different roots of Quadratics
/// that have a root in common are further apart: both are rational with denominators below 2^104,
/// or both are roots of one Quadratic.
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

/// True only if q >= 0 on all of [0, 1]: its Bernstein coefficients are not negative, and q is a
/// combination of them with weights >= 0. False where that test does not tell.
inline bool BernsteinNonNegative(const Quadratic& q) {
  return q.c0 >= 0 && 2 * q.c0 + q.c1 >= 0 && q.c0 + q.c1 + q.c2 >= 0;
}

/// Whether one polynomial is a multiple of the other. Exact, for coefficients of any size.
bool Proportional(const Quadratic& p, const Quadratic& q);

/// The sign of c1^2 - 4 c2 c0, exactly. Requires: |c2| < 2^124; c0, c1 of any size.
int DiscriminantSign(const Quadratic& q);

/// A real root of a polynomial that is not constant: the lower or the upper of two, or the only
/// one.
struct QuadraticRoot {
  Quadratic q;
  bool upper = false;

  /// The number itself, as the root of 2^k t - n. Requires: k <= 103. That holds for every number
  /// at which a Quadratic is 0 without being 0 everywhere: 2^k divides one of its coefficients.
  static QuadraticRoot At(Dyadic t);
  static QuadraticRoot At(const WideDyadic& t);
};

/// The sign of root - x, from the signs at x of root.q (`value`) and of its derivative (`slope`).
int SideOf(const QuadraticRoot& root, int value, int slope);

/// A root in floating point.
struct RootEstimate {
  double value = 0;
  /// `value` is within kRootEstimateError * max(1, |root|) of the root. False where the
  /// discriminant loses too many digits for that; `value` is then no more than a first guess.
  bool reliable = false;
};
inline constexpr double kRootEstimateError = 0x1p-28;
RootEstimate ApproximateRoot(const QuadraticRoot& root);

/// The sign of root - t, exactly. Requires: the root is real.
int Compare(const QuadraticRoot& root, Dyadic t);
int Compare(const QuadraticRoot& root, const WideDyadic& t);

/// The sign of r - s, exactly: by doubles; then by bisection; then, where bisection leaves the two
/// together, by the resultant. Requires: both in [0, 1].
int Compare(const QuadraticRoot& r, const QuadraticRoot& s);

/// True only if r = s, and then as a rule where no other root of the two polynomials is near: much
/// faster than Compare. Exact.
bool SurelyEqual(const QuadraticRoot& r, const QuadraticRoot& s);

/// The coarsest dyadic number strictly between; nullopt where lo >= hi. Requires: both in [0, 1].
std::optional<WideDyadic> Between(const QuadraticRoot& lo, const QuadraticRoot& hi);

/// The largest closed interval around t on which q >= 0. An end that is missing is at infinity.
struct NonNegativeRange {
  bool point = false;  ///< the interval is t alone; no ends are given
  std::optional<QuadraticRoot> from;
  std::optional<QuadraticRoot> to;
};
/// Requires: q(t) >= 0.
NonNegativeRange NonNegativeAround(const Quadratic& q, Dyadic t);
NonNegativeRange NonNegativeAround(const Quadratic& q, const WideDyadic& t);

}  // namespace farhorizon

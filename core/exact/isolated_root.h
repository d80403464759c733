#pragma once

#include <optional>
#include <vector>

#include "core/exact/quadratic.h"

namespace farhorizon {

/// A root in [0, 1] with a bracket that tells it from most others at once: lo <= root <= hi, both
/// multiples of 2^-kBracketBits, next to each other or the same.
struct IsolatedRoot {
  QuadraticRoot root;
  double lo = 0;
  double hi = 0;

  static IsolatedRoot Zero() { return {QuadraticRoot::At(Dyadic{0, 0}), 0, 0}; }
  static IsolatedRoot One() { return {QuadraticRoot::At(Dyadic{1, 0}), 1, 1}; }

  /// Within 2^-47 of the root.
  [[nodiscard]] double ToDouble() const;
};
inline constexpr int kBracketBits = 30;

/// The sign of r - s, exactly.
int Compare(const IsolatedRoot& r, const IsolatedRoot& s);

/// The roots strictly between 0 and 1 at which q changes its sign, rising.
std::vector<IsolatedRoot> SignChanges(const Quadratic& q);

/// A dyadic number to evaluate polynomials at; wide only where 128 bits cannot say it.
struct SamplePoint {
  Dyadic t;
  std::optional<WideDyadic> wide;

  /// The sign of q between its sign changes on either side, exactly: that here, or that around where q
  /// only touches zero here; 0 where q is zero everywhere. Requires: q does not change its sign here.
  [[nodiscard]] int Sign(const Quadratic& q) const {
    const int sign = wide ? SignAt(q, *wide) : SignAt(q, t);
    return sign != 0 ? sign : SignOf(q.c2);
  }
  /// Rounded: within 2^-53 of it.
  [[nodiscard]] double ToDouble() const { return wide ? wide->ToDouble() : t.ToDouble(); }
};

/// A number strictly between. Requires: r < s.
SamplePoint PointBetween(const IsolatedRoot& r, const IsolatedRoot& s);

}  // namespace farhorizon

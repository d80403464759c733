#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "core/exact/quadratic.h"

namespace farhorizon {

/// A root in [0, 1] with a bracket, lo <= root <= hi, which orders it against most others without
/// further arithmetic. lo and hi are multiples of 2^-kBracketBits, neighbours or equal.
struct IsolatedRoot {
  QuadraticRoot root;
  double lo = 0;
  double hi = 0;

  static IsolatedRoot Zero() { return {QuadraticRoot::At(Dyadic{0, 0}), 0, 0}; }
  static IsolatedRoot One() { return {QuadraticRoot::At(Dyadic{1, 0}), 1, 1}; }

  /// Within 2^-47 of the root.
  [[nodiscard]] double ToDouble() const;
};
/// Any count up to 52 is sound: brackets are then exact doubles. 30 tell apart what two doubles of
/// ApproximateRoot tell apart, kRootEstimateError being 2^-28.
inline constexpr int kBracketBits = 30;

/// The sign of r - s, exactly.
int Compare(const IsolatedRoot& r, const IsolatedRoot& s);

/// A number within 2^-bits of the root, of `bits` bits at most. Requires: kBracketBits <= bits <=
/// kMaxWideDyadicBits. Cost: a wide comparison for each bit beyond the bracket's.
WideDyadic Refined(const IsolatedRoot& root, int bits);

/// Up to two roots, ascending.
class RootPair {
 public:
  RootPair() = default;
  explicit RootPair(const IsolatedRoot& root) : roots_{root}, size_(1) {}
  RootPair(const IsolatedRoot& first, const IsolatedRoot& second)
      : roots_{first, second}, size_(2) {}

  [[nodiscard]] const IsolatedRoot* begin() const { return roots_.data(); }
  [[nodiscard]] const IsolatedRoot* end() const { return roots_.data() + size_; }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] const IsolatedRoot& operator[](std::size_t i) const { return roots_[i]; }

 private:
  std::array<IsolatedRoot, 2> roots_;
  std::size_t size_ = 0;
};

/// The roots strictly between 0 and 1 at which q changes its sign.
RootPair SignChanges(const Quadratic& q);

/// A dyadic number at which polynomials are evaluated. `wide` is set only where 128 bits do not
/// hold it; it counts in place of `t` then.
struct SamplePoint {
  Dyadic t;
  std::optional<WideDyadic> wide;

  /// The sign that q has between its nearest sign changes on either side of the point, exactly.
  /// Where q touches zero at the point, that is the sign around it; 0 where q is zero everywhere.
  /// Requires: q does not change its sign at the point.
  [[nodiscard]] int Sign(const Quadratic& q) const {
    const int sign = wide ? SignAt(q, *wide) : SignAt(q, t);
    return sign != 0 ? sign : SignOf(q.c2);
  }
  /// Within 2^-52 of it.
  [[nodiscard]] double ToDouble() const { return wide ? wide->ToDouble() : t.ToDouble(); }
};

/// A number strictly between. Requires: r < s.
SamplePoint PointBetween(const IsolatedRoot& r, const IsolatedRoot& s);

}  // namespace farhorizon

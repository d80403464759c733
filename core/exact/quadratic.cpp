// Roots of quadratics with integer coefficients, compared without rounding.
//
// A root is never computed. It is its polynomial and which of the two roots it is; its place
// relative to a dyadic number t follows from the signs of the polynomial and of its derivative at
// t. Two roots are compared by doubles where both are well conditioned and far apart, else by
// bisection with dyadic numbers, and once by the resultant of the two polynomials, which is 0 if
// they share a root. Bounds on the integers are in quadratic.h; the largest is about 2^525, in
// IsRational.
#include "core/exact/quadratic.h"

#include <algorithm>
#include <cmath>

#include "core/base/result.h"

namespace farhorizon {

namespace {

// After so many halvings Compare asks, once, whether roots that are still together are one number.
// Any count is sound: a smaller one computes more resultants of roots that differ, a larger one
// halves in vain where they are equal.
constexpr int kHalvingsBeforeResultant = 30;

constexpr const char* kRootsSeparate = "different roots are separated by 2^-424";

// Whether value and slope at t fit in 128 bits. Each is at most three terms of a coefficient's size
// times 2^2k (or 2^k+1), and 3 * 2^124 < 2^127.
bool IsNarrow(const Quadratic& q, Dyadic t) {
  if (t.k <= 10) return true;  // 104 + 2 * 10 = 124
  if (t.k > 60) return false;
  const Int128 most = Int128{1} << (124 - 2 * t.k);
  const auto small = [most](Int128 c) { return c < most && c > -most; };
  return small(q.c0) && small(q.c1) && small(q.c2);
}

// The sign of the derivative 2 c2 t + c1.
int SlopeAt(const Quadratic& q, const WideDyadic& t) {
  return SignOf(Int1280(2 * q.c2) * t.n + (Int1280(q.c1) << t.k));
}

int SlopeAt(const Quadratic& q, Dyadic t) {
  if (IsNarrow(q, t)) return SignOf(2 * q.c2 * t.n + (q.c1 << t.k));
  return SlopeAt(q, Widened(t));
}

// The sign of a - b where both estimates are reliable and their errors cannot make up the
// difference; 0 otherwise.
int SurelyApart(RootEstimate a, RootEstimate b) {
  if (!a.reliable || !b.reliable) return 0;
  const double most =
      2 * kRootEstimateError * std::max({1.0, std::abs(a.value), std::abs(b.value)});
  const double difference = a.value - b.value;
  return static_cast<int>(difference > most) - static_cast<int>(difference < -most);
}

// Whether two polynomials have a root in common, one at infinity included: their resultant is zero.
bool ShareARoot(const Quadratic& p, const Quadratic& q) {
  const Int1280 p0(p.c0);
  const Int1280 p1(p.c1);
  const Int1280 p2(p.c2);
  const Int1280 q0(q.c0);
  const Int1280 q1(q.c1);
  const Int1280 q2(q.c2);
  const Int1280 ends = p0 * q2 - p2 * q0;
  return ends * ends == (p0 * q1 - p1 * q0) * (p1 * q2 - p2 * q1);
}

// Whether the root is u / v. Requires: v > 0; |u|, v < 2^209.
bool IsRational(const QuadraticRoot& root, const Int1280& u, const Int1280& v) {
  const Int1280 c0(root.q.c0);
  const Int1280 c1(root.q.c1);
  const Int1280 c2(root.q.c2);
  const Int1280 value = c0 * v * v + c1 * u * v + c2 * u * u;  // < 3 * 2^(104 + 2 * 209)
  const Int1280 slope = (c2 << 1) * u + c1 * v;
  return SideOf(root, SignOf(value), SignOf(slope)) == 0;
}

// Whether the roots are one number. Requires: their polynomials share a root.
bool SameNumber(const QuadraticRoot& r, const QuadraticRoot& s) {
  const Quadratic& p = r.q;
  const Quadratic& q = s.q;
  if (Proportional(p, q)) {
    if (p.c2 == 0 || DiscriminantSign(p) == 0) return true;
    return r.upper == s.upper;  // lower and upper are by value, whatever the sign of c2
  }
  // Eliminating t^2 leaves (p1 q2 - p2 q1) t = p2 q0 - p0 q2, the common root.
  Int1280 v = Int1280(p.c1) * Int1280(q.c2) - Int1280(p.c2) * Int1280(q.c1);
  Int1280 u = Int1280(p.c2) * Int1280(q.c0) - Int1280(p.c0) * Int1280(q.c2);
  if (SignOf(v) == 0) return false;
  if (SignOf(v) < 0) {
    u = -u;
    v = -v;
  }
  return IsRational(r, u, v) && IsRational(s, u, v);
}

// The sign of r - s, by bisection that goes on at `middle`. Requires: r and s differ, and lie on
// the same sides of all numbers tried before.
int Separate(const QuadraticRoot& r, const QuadraticRoot& s, WideDyadic middle) {
  while (true) {
    const int r_side = Compare(r, middle);
    const int s_side = Compare(s, middle);
    if (r_side != s_side) return r_side > s_side ? 1 : -1;
    Check(r_side != 0 && middle.k < kMaxWideDyadicBits, kRootsSeparate);
    middle = {(middle.n << 1) + Int1280(r_side), middle.k + 1};
  }
}

template <typename Number>
NonNegativeRange RangeAround(const Quadratic& q, const Number& t) {
  NonNegativeRange range;
  if (q.c1 == 0 && q.c2 == 0) return range;
  Check(SignAt(q, t) >= 0, "a polynomial is not negative where its range is asked");
  if (q.c2 == 0) {
    (q.c1 > 0 ? range.from : range.to) = QuadraticRoot{q, false};
    return range;
  }
  const int discriminant = DiscriminantSign(q);
  if (q.c2 < 0) {
    range.point = discriminant == 0;
    if (range.point) return range;
    range.from = QuadraticRoot{q, false};
    range.to = QuadraticRoot{q, true};
    return range;
  }
  if (discriminant <= 0) return range;
  if (SlopeAt(q, t) < 0) {
    range.to = QuadraticRoot{q, false};
  } else {
    range.from = QuadraticRoot{q, true};
  }
  return range;
}

}  // namespace

WideDyadic Widened(Dyadic t) { return {Int1280(t.n), t.k}; }

Dyadic Narrowed(const WideDyadic& t) {
  Check(t.k <= kMaxDyadicBits, "a number to be narrowed is no finer than 2^-70");
  return {static_cast<Int128>(t.n), t.k};
}

int SignAt(const Quadratic& q, Dyadic t) {
  if (!IsNarrow(q, t)) return SignAt(q, Widened(t));
  const Int128 high = q.c2 * t.n + (q.c1 << t.k);
  return SignOf(high * t.n + (q.c0 << (2 * t.k)));
}

int SignAt(const Quadratic& q, const WideDyadic& t) {
  const Int1280 high = Int1280(q.c2) * t.n + (Int1280(q.c1) << t.k);
  return SignOf(high * t.n + (Int1280(q.c0) << (2 * t.k)));
}

bool Proportional(const Quadratic& p, const Quadratic& q) {
  return CompareProducts(p.c0, q.c1, p.c1, q.c0) == 0 &&
         CompareProducts(p.c0, q.c2, p.c2, q.c0) == 0 &&
         CompareProducts(p.c1, q.c2, p.c2, q.c1) == 0;
}

int DiscriminantSign(const Quadratic& q) { return CompareProducts(q.c1, q.c1, 4 * q.c2, q.c0); }

QuadraticRoot QuadraticRoot::At(const WideDyadic& t) {
  Check(t.k <= 103, "a dyadic root of a polynomial is no finer than its coefficients");
  return At(Dyadic{static_cast<Int128>(t.n), t.k});
}

QuadraticRoot QuadraticRoot::At(Dyadic t) { return {{-t.n, Int128{1} << t.k, 0}, false}; }

// A parabola that opens upwards is negative between its roots. Outside them it falls before the
// lower root and rises after the upper one; at a root it does the same, or is flat where there is
// one only:
//
//   above > 0   \           /   above > 0
//   falls        \         /    rises
//   --------------o-------o------------- axis
//             lower \___/ upper
//                above < 0
int SideOf(const QuadraticRoot& root, int value, int slope) {
  if (root.q.c2 == 0) return -value * SignOf(root.q.c1);
  const int opening = SignOf(root.q.c2);
  const int above = value * opening;  // as if the parabola opened upwards
  const int rising = slope * opening;
  if (above < 0) return root.upper ? 1 : -1;
  if (above > 0) return -rising;
  if (rising == 0) return 0;
  if (rising < 0) return root.upper ? 1 : 0;
  return root.upper ? 0 : -1;
}

// Error: with M = c1^2 + 4 |c2 c0| the computed discriminant is off by at most 2^-50 M, so by 2^-30
// of itself where it is at least 2^-20 M. Its square root is then off by 2^-31 of itself. `sum`
// adds two numbers of one sign, and `sum`, the quotients and the conversions add a few 2^-53: in
// all less than 2^-28 of the root.
RootEstimate ApproximateRoot(const QuadraticRoot& root) {
  const auto c0 = static_cast<double>(root.q.c0);
  const auto c1 = static_cast<double>(root.q.c1);
  if (root.q.c2 == 0) return {-c0 / c1, true};
  const auto c2 = static_cast<double>(root.q.c2);
  const double square = c1 * c1;
  const double product = 4 * c2 * c0;
  const double discriminant = square - product;
  const bool reliable = discriminant >= 0x1p-20 * (square + std::abs(product));
  const double width = std::sqrt(std::max(discriminant, 0.0));
  // c2 times one root, without cancellation; the product of the roots is c0 / c2.
  const double sum = -(c1 + std::copysign(width, c1)) / 2;
  const bool sum_is_upper = (sum > -c1 / 2) == (c2 > 0);
  if (width == 0 || sum_is_upper == root.upper) return {sum / c2, reliable};
  return {sum == 0 ? 0 : c0 / sum, reliable};
}

int Compare(const QuadraticRoot& root, Dyadic t) {
  const RootEstimate at{t.ToDouble(), true};
  if (const int apart = SurelyApart(ApproximateRoot(root), at); apart != 0) return apart;
  return SideOf(root, SignAt(root.q, t), SlopeAt(root.q, t));
}

int Compare(const QuadraticRoot& root, const WideDyadic& t) {
  return SideOf(root, SignAt(root.q, t), SlopeAt(root.q, t));
}

int Compare(const QuadraticRoot& r, const QuadraticRoot& s) {
  if (const int apart = SurelyApart(ApproximateRoot(r), ApproximateRoot(s)); apart != 0) {
    return apart;
  }
  const Dyadic zero{0, 0};
  const Dyadic one{1, 0};
  const int r0 = Compare(r, zero);
  const int s0 = Compare(s, zero);
  const int r1 = Compare(r, one);
  const int s1 = Compare(s, one);
  Check(r0 >= 0 && s0 >= 0 && r1 <= 0 && s1 <= 0, "roots to compare lie in [0, 1]");
  if (r0 == 0 || s0 == 0) return r0 - s0;
  if (r1 == 0 || s1 == 0) return r1 - s1;
  Dyadic middle{1, 1};
  while (true) {
    const int r_side = Compare(r, middle);
    const int s_side = Compare(s, middle);
    if (r_side != s_side) return r_side > s_side ? 1 : -1;
    if (r_side == 0) return 0;
    if (middle.k == kHalvingsBeforeResultant && ShareARoot(r.q, s.q) && SameNumber(r, s)) return 0;
    middle = {2 * middle.n + r_side, middle.k + 1};
    if (middle.k > kMaxDyadicBits) return Separate(r, s, Widened(middle));
  }
}

// Where the polynomials have a root in common, and each other pair of their roots is apart, this is
// the one. A root at infinity, that of a polynomial of degree one, is apart from all others.
bool SurelyEqual(const QuadraticRoot& r, const QuadraticRoot& s) {
  if (r.q.c2 == 0 && s.q.c2 == 0) return false;
  const auto apart = [](const QuadraticRoot& a, const QuadraticRoot& b) {
    return SurelyApart(ApproximateRoot(a), ApproximateRoot(b)) != 0;
  };
  const QuadraticRoot other_r{r.q, !r.upper};
  const QuadraticRoot other_s{s.q, !s.upper};
  if (r.q.c2 != 0 && !apart(other_r, s)) return false;
  if (s.q.c2 != 0 && !apart(r, other_s)) return false;
  if (r.q.c2 != 0 && s.q.c2 != 0 && !apart(other_r, other_s)) return false;
  return ShareARoot(r.q, s.q);
}

std::optional<WideDyadic> Between(const QuadraticRoot& lo, const QuadraticRoot& hi) {
  if (Compare(lo, hi) >= 0) return std::nullopt;
  Dyadic middle{1, 1};
  while (middle.k <= kMaxDyadicBits) {
    if (Compare(lo, middle) >= 0) {
      middle = {2 * middle.n + 1, middle.k + 1};
    } else if (Compare(hi, middle) <= 0) {
      middle = {2 * middle.n - 1, middle.k + 1};
    } else {
      return Widened(middle);
    }
  }
  WideDyadic fine = Widened(middle);
  while (true) {
    int side = 0;
    if (Compare(lo, fine) >= 0) {
      side = 1;
    } else if (Compare(hi, fine) <= 0) {
      side = -1;
    } else {
      return fine;
    }
    fine = {(fine.n << 1) + Int1280(side), fine.k + 1};
    Check(fine.k <= kMaxWideDyadicBits, kRootsSeparate);
  }
}

NonNegativeRange NonNegativeAround(const Quadratic& q, Dyadic t) { return RangeAround(q, t); }
NonNegativeRange NonNegativeAround(const Quadratic& q, const WideDyadic& t) {
  return RangeAround(q, t);
}

}  // namespace farhorizon

// Numbers that are roots of quadratics with integer coefficients, compared without rounding.
// A root is known by its polynomial and by which root it is, and placed against dyadic numbers by
// the signs of the polynomial and of its derivative there. Doubles decide first where roots are well
// conditioned and the numbers far apart.
#include "core/exact/quadratic.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <boost/multiprecision/cpp_int.hpp>

#include "core/base/result.h"

namespace farhorizon {
namespace {

using BigInt = boost::multiprecision::cpp_int;

// Whether the value and the slope at t fit in 128 bits: three terms of the coefficients' size times
// 2^2k, with two carries.
bool IsNarrow(const Quadratic& q, Dyadic t) {
  if (t.k <= 10) return true;
  if (t.k > 60) return false;
  const Int128 most = Int128{1} << (124 - 2 * t.k);
  const auto small = [most](Int128 c) { return c < most && c > -most; };
  return small(q.c0) && small(q.c1) && small(q.c2);
}

// The sign of the derivative 2 c2 t + c1.
int SlopeAt(const Quadratic& q, Dyadic t) {
  if (IsNarrow(q, t)) return SignOf(2 * q.c2 * t.n + (q.c1 << t.k));
  return BigInt(2 * BigInt(q.c2) * BigInt(t.n) + (BigInt(q.c1) << t.k)).sign();
}

int SlopeAt(const Quadratic& q, const WideDyadic& t) {
  return SignOf((Int1280(2 * q.c2) * t.n) + (Int1280(q.c1) << t.k));
}

// The root in doubles, within kNearError of itself (or of 1 where it is smaller); NaN where the
// discriminant loses too many digits for that.
//
// With M = c1^2 + 4 |c2 c0| the discriminant D is off by at most 2^-50 M, so by 2^-30 of itself where
// D >= 2^-20 M; the sum with c1 of like sign and the quotients add a few 2^-53.
constexpr double kNearError = 0x1p-28;

double Near(const QuadraticRoot& root) {
  const auto c0 = static_cast<double>(root.q.c0);
  const auto c1 = static_cast<double>(root.q.c1);
  if (root.q.c2 == 0) return -c0 / c1;
  const auto c2 = static_cast<double>(root.q.c2);
  const double square = c1 * c1;
  const double product = 4 * c2 * c0;
  const double discriminant = square - product;
  if (!(discriminant >= 0x1p-20 * (square + std::abs(product)))) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  const double sum = c1 + std::copysign(std::sqrt(discriminant), c1);
  const double one = -sum / (2 * c2);
  const double other = -2 * c0 / sum;
  return root.upper ? std::max(one, other) : std::min(one, other);
}

// The sign of a - b where it is sure, 0 otherwise, NaN included.
int SurelyApart(double a, double b) {
  const double most = 2 * kNearError * std::max({1.0, std::abs(a), std::abs(b)});
  return static_cast<int>(a - b > most) - static_cast<int>(b - a > most);
}

int DiscriminantSign(const Quadratic& q) { return CompareProducts(q.c1, q.c1, 4 * q.c2, q.c0); }

// Whether two polynomials have a root in common, one at infinity included: their resultant is zero.
bool ShareARoot(const Quadratic& p, const Quadratic& q) {
  const BigInt p0(p.c0);
  const BigInt p1(p.c1);
  const BigInt p2(p.c2);
  const BigInt q0(q.c0);
  const BigInt q1(q.c1);
  const BigInt q2(q.c2);
  const BigInt ends = p0 * q2 - p2 * q0;
  return BigInt(ends * ends - (p0 * q1 - p1 * q0) * (p1 * q2 - p2 * q1)) == 0;
}

bool Proportional(const Quadratic& p, const Quadratic& q) {
  return CompareProducts(p.c0, q.c1, p.c1, q.c0) == 0 &&
         CompareProducts(p.c0, q.c2, p.c2, q.c0) == 0 &&
         CompareProducts(p.c1, q.c2, p.c2, q.c1) == 0;
}

// The sign of root - x, from the signs of the polynomial and of its derivative at x.
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

// Whether the root is u / v, v > 0.
bool IsRational(const QuadraticRoot& root, const BigInt& u, const BigInt& v) {
  const Quadratic& q = root.q;
  const BigInt value = BigInt(q.c0) * v * v + BigInt(q.c1) * u * v + BigInt(q.c2) * u * u;
  const BigInt slope = 2 * BigInt(q.c2) * u + BigInt(q.c1) * v;
  return SideOf(root, value.sign(), slope.sign()) == 0;
}

// Whether the roots are one number, given that their polynomials share a root.
bool SameNumber(const QuadraticRoot& r, const QuadraticRoot& s) {
  const Quadratic& p = r.q;
  const Quadratic& q = s.q;
  if (Proportional(p, q)) {
    if (p.c2 == 0 || DiscriminantSign(p) == 0) return true;
    return r.upper == s.upper;  // lower and upper are by value, whatever the sign of c2
  }
  // Eliminating t^2 leaves (p1 q2 - p2 q1) t = p2 q0 - p0 q2, the common root.
  BigInt v = BigInt(p.c1) * BigInt(q.c2) - BigInt(p.c2) * BigInt(q.c1);
  BigInt u = BigInt(p.c2) * BigInt(q.c0) - BigInt(p.c0) * BigInt(q.c2);
  if (v == 0) return false;
  if (v < 0) {
    u = -u;
    v = -v;
  }
  return IsRational(r, u, v) && IsRational(s, u, v);
}

// Where the roots are told apart by halving on from `middle`, with which neither has been compared:
// the sign of r - s. Requires: they differ.
int Part(const QuadraticRoot& r, const QuadraticRoot& s, WideDyadic middle) {
  while (true) {
    const int r_side = Compare(r, middle);
    const int s_side = Compare(s, middle);
    if (r_side != s_side) return r_side > s_side ? 1 : -1;
    Check(r_side != 0 && middle.k < kMaxWideDyadicBits, "different roots are parted by 2^-424");
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
  if (IsNarrow(q, t)) {
    const Int128 high = q.c2 * t.n + (q.c1 << t.k);
    return SignOf(high * t.n + (q.c0 << (2 * t.k)));
  }
  const BigInt n(t.n);
  const BigInt high = BigInt(q.c2) * n + (BigInt(q.c1) << t.k);
  return BigInt(high * n + (BigInt(q.c0) << (2 * t.k))).sign();
}

int SignAt(const Quadratic& q, const WideDyadic& t) {
  const Int1280 high = Int1280(q.c2) * t.n + (Int1280(q.c1) << t.k);
  return SignOf(high * t.n + (Int1280(q.c0) << (2 * t.k)));
}

QuadraticRoot QuadraticRoot::At(const WideDyadic& t) {
  Check(t.k <= 103, "a dyadic root of a polynomial is no finer than its coefficients");
  return At(Dyadic{static_cast<Int128>(t.n), t.k});
}

QuadraticRoot QuadraticRoot::At(Dyadic t) { return {{-t.n, Int128{1} << t.k, 0}, false}; }

int Compare(const QuadraticRoot& root, Dyadic t) {
  if (const int apart = SurelyApart(Near(root), t.ToDouble()); apart != 0) return apart;
  return SideOf(root, SignAt(root.q, t), SlopeAt(root.q, t));
}

int Compare(const QuadraticRoot& root, const WideDyadic& t) {
  return SideOf(root, SignAt(root.q, t), SlopeAt(root.q, t));
}

int Compare(const QuadraticRoot& r, const QuadraticRoot& s) {
  if (const int apart = SurelyApart(Near(r), Near(s)); apart != 0) return apart;
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
    // Where 30 halvings do not part them they are probably one number: ask once.
    if (middle.k == 30 && ShareARoot(r.q, s.q) && SameNumber(r, s)) return 0;
    middle = {2 * middle.n + r_side, middle.k + 1};
    if (middle.k > kMaxDyadicBits) return Part(r, s, Widened(middle));
  }
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
    Check(fine.k <= kMaxWideDyadicBits, "different roots are parted by 2^-424");
  }
}

NonNegativeRange NonNegativeAround(const Quadratic& q, Dyadic t) { return RangeAround(q, t); }
NonNegativeRange NonNegativeAround(const Quadratic& q, const WideDyadic& t) {
  return RangeAround(q, t);
}

}  // namespace farhorizon

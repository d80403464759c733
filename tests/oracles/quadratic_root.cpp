#include "tests/oracles/quadratic_root.h"

#include <cmath>
#include <utility>

namespace farhorizon::oracle {
namespace {

// The quotient of two correctly rounded numbers, a square root and a sum of equal signs: a few
// units in the last of 64 bits for numbers in [0, 1].
constexpr long double kNearlyError = 0x1p-50L;

int SignOf(const Wide& x) { return x < 0 ? -1 : (x > 0 ? 1 : 0); }

// Sign of a + b sqrt(d), d >= 0.
int SignOfSum(const Wide& a, const Wide& b, const Wide& d) {
  const int sign_a = SignOf(a);
  const int sign_b = d == 0 ? 0 : SignOf(b);
  if (sign_a == sign_b || sign_b == 0) return sign_a;
  if (sign_a == 0) return sign_b;
  const int larger = SignOf(a * a - b * b * d);
  return larger == 0 ? 0 : (larger > 0 ? sign_a : sign_b);
}

// Sign of n + b sqrt(d) + c sqrt(e), d and e >= 0.
int SignOfSum(const Wide& n, const Wide& b, const Wide& d, const Wide& c, const Wide& e) {
  // The two roots together: b sqrt(d) against -c sqrt(e).
  const Wide first = b * b * d;
  const Wide second = c * c * e;
  const int sign_b = SignOf(first) * SignOf(b);
  const int sign_c = SignOf(second) * SignOf(c);
  int roots = sign_b;
  if (sign_b == 0) roots = sign_c;
  if (sign_b * sign_c < 0) roots = first == second ? 0 : (first > second ? sign_b : sign_c);
  const int sign_n = SignOf(n);
  if (sign_n == roots || roots == 0) return sign_n;
  if (sign_n == 0) return roots;
  // Opposite signs: n^2 against (b sqrt(d) + c sqrt(e))^2.
  const int larger = SignOfSum(n * n - first - second, -2 * b * c, d * e);
  return larger == 0 ? 0 : (larger > 0 ? sign_n : roots);
}

long double Nearly(const Wide& x) { return x.convert_to<long double>(); }

}  // namespace

Quadratic Cross(const MovingVector& v, const MovingVector& w) {
  return {v.x0 * w.y0 - v.y0 * w.x0, v.x0 * w.y1 - v.y0 * w.x1 + v.x1 * w.y0 - v.y1 * w.x0,
          v.x1 * w.y1 - v.y1 * w.x1};
}

QuadraticNumber::QuadraticNumber(Wide p, Wide q, Wide d, int s)
    : p_(std::move(p)), q_(std::move(q)), d_(std::move(d)), s_(s), nearly_(0) {
  if (q_ < 0) {
    p_ = -p_;
    q_ = -q_;
    s_ = -s_;
  }
  if (s_ == 0) {
    nearly_ = Nearly(p_) / Nearly(q_);
  } else if (SignOf(p_) * s_ >= 0) {
    nearly_ = (Nearly(p_) + static_cast<long double>(s_) * std::sqrt(Nearly(d_))) / Nearly(q_);
  } else {
    // The conjugate's sum has equal signs, where this one would cancel.
    nearly_ = Nearly(p_ * p_ - d_) /
              (Nearly(q_) * (Nearly(p_) - static_cast<long double>(s_) * std::sqrt(Nearly(d_))));
  }
}

QuadraticNumber QuadraticNumber::Rational(const Wide& numerator, const Wide& denominator) {
  return {numerator, denominator, 0, 0};
}

int Compare(const QuadraticNumber& a, const QuadraticNumber& b) {
  if (a.nearly_ - b.nearly_ > 2 * kNearlyError) return 1;
  if (b.nearly_ - a.nearly_ > 2 * kNearlyError) return -1;
  return SignOfSum(a.p_ * b.q_ - b.p_ * a.q_, a.s_ * b.q_, a.d_, -b.s_ * a.q_, b.d_);
}

std::vector<QuadraticNumber> RootsInside(const Quadratic& f) {
  std::vector<QuadraticNumber> roots;
  const auto keep = [&roots](const QuadraticNumber& root) {
    static const QuadraticNumber zero = QuadraticNumber::Rational(0, 1);
    static const QuadraticNumber one = QuadraticNumber::Rational(1, 1);
    // Far outside the unit interval the approximation says nothing but that.
    if (root.nearly_ > -1 && root.nearly_ < 2 && zero < root && root < one) roots.push_back(root);
  };
  if (f.c2 == 0) {
    if (f.c1 != 0) keep(QuadraticNumber::Rational(-f.c0, f.c1));
    return roots;
  }
  const Wide discriminant = f.c1 * f.c1 - 4 * f.c2 * f.c0;
  if (discriminant < 0) return roots;
  if (discriminant == 0) {
    keep(QuadraticNumber::Rational(-f.c1, 2 * f.c2));
    return roots;
  }
  keep(QuadraticNumber(-f.c1, 2 * f.c2, discriminant, -1));
  keep(QuadraticNumber(-f.c1, 2 * f.c2, discriminant, 1));
  return roots;
}

DyadicNumber SimplestBetween(const QuadraticNumber& low, const QuadraticNumber& high) {
  DyadicNumber below{0, 0};  // the greatest number of its exponent that is not above `low`
  for (;;) {
    const DyadicNumber next{below.numerator + 1, below.exponent};
    if (QuadraticNumber::Dyadic(next.numerator, next.exponent) < high) return next;
    ++below.exponent;
    below.numerator *= 2;
    if (!(low < QuadraticNumber::Dyadic(below.numerator + 1, below.exponent))) ++below.numerator;
  }
}

}  // namespace farhorizon::oracle

// SweepDepths are never computed, only placed: by intervals of long doubles, which nearly always
// tell two of them apart, and else by the signs of polynomials and of sums of roots in wide
// integers.
#include "core/horizon/kinetic/hulls/sweep_depth.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/result.h"

namespace farhorizon::kinetic {

namespace {

// A closed interval that contains the exact value.
struct Interval {
  long double lo;
  long double hi;
};

// One operation is off by half an epsilon at most; the rest pays for rounding in Widen() itself.
constexpr long double kSlack = std::numeric_limits<long double>::epsilon() * 2;

Interval Widen(long double lo, long double hi) {
  return {lo - std::fabs(lo) * kSlack, hi + std::fabs(hi) * kSlack};
}

Interval IntervalOf(Int128 value) {
  const auto v = static_cast<long double>(value);
  return Widen(v, v);
}

Interval operator+(Interval a, Interval b) { return Widen(a.lo + b.lo, a.hi + b.hi); }
Interval operator-(Interval a) { return {-a.hi, -a.lo}; }

Interval operator*(Interval a, Interval b) {
  const auto [lo, hi] = std::minmax({a.lo * b.lo, a.lo * b.hi, a.hi * b.lo, a.hi * b.hi});
  return Widen(lo, hi);
}

bool HasZero(Interval a) { return a.lo <= 0 && a.hi >= 0; }

Interval operator/(Interval a, Interval b) {
  constexpr long double kInfinite = std::numeric_limits<long double>::infinity();
  if (HasZero(b)) return {-kInfinite, kInfinite};
  const auto [lo, hi] = std::minmax({a.lo / b.lo, a.lo / b.hi, a.hi / b.lo, a.hi / b.hi});
  return Widen(lo, hi);
}

Interval Root(Interval a) {
  return Widen(std::sqrt(std::max(a.lo, 0.0L)), std::sqrt(std::max(a.hi, 0.0L)));
}

// The signs of the value and of the slope of q at a whole number. By the bounds of Compare() all
// sums are below 2^126.
struct LocalSigns {
  int value;
  int slope;
};
LocalSigns At(const Quadratic& q, std::int64_t s) {
  return {SignOf((q.c2 * s + q.c1) * s + q.c0), SignOf(2 * q.c2 * s + q.c1)};
}

// The sign of root - s.
int SideOf(const SweepDepth& root, std::int64_t s) {
  const LocalSigns at = At(root.q, s);
  return farhorizon::SideOf({root.q, root.upper}, at.value, at.slope);
}

SweepDepth RootAt(const Quadratic& q, bool upper, Interval where) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  SweepDepth root;
  root.whole = false;
  root.q = q;
  root.upper = upper;
  root.lo = std::nextafter(static_cast<double>(where.lo), -kInfinite);
  root.hi = std::nextafter(static_cast<double>(where.hi), kInfinite);
  const double nearest = std::round(root.lo + (root.hi - root.lo) / 2);
  if (std::fabs(nearest) < 0x1p31 && root.lo <= nearest && nearest <= root.hi) {
    const auto s = static_cast<std::int64_t>(nearest);
    if (SideOf(root, s) == 0) return SweepDepth::At(s);
  }
  return root;
}

// (a + b sqrt(x)) / d, with b in {-1, 0, 1}, x >= 0, d > 0.
struct Surd {
  Int1280 a;
  Int128 b = 0;
  Int1280 x;
  Int1280 d;
};

Surd SurdOf(const SweepDepth& root) {
  const Quadratic& q = root.q;
  const bool negative = (q.c2 != 0 ? q.c2 : q.c1) < 0;
  const auto turned = [negative](Int128 c) { return Int1280(negative ? -c : c); };
  if (q.c2 == 0) return {-turned(q.c0), 0, Int1280(0), turned(q.c1)};
  const Int1280 c1(q.c1);
  const Int1280 x = c1 * c1 - ((Int1280(q.c2) * Int1280(q.c0)) << 2);
  return {-turned(q.c1), root.upper ? 1 : -1, x, turned(2 * q.c2)};
}

// The sign of a + b sqrt(x), x >= 0.
int SignOfSum(const Int1280& a, const Int1280& b, const Int1280& x) {
  const int sign_a = SignOf(a);
  const int sign_b = SignOf(x) == 0 ? 0 : SignOf(b);
  if (sign_a * sign_b >= 0) return sign_a != 0 ? sign_a : sign_b;
  return sign_a * SignOf(a * a - b * b * x);
}

// By squaring twice. c2 is below 2^36, c1 below 2^84, c0 below 2^124 (kinetic_sweep.cpp), so the
// terms of the first sum are below 2^210 and those of the last one below 2^850.
int CompareRoots(const SweepDepth& a, const SweepDepth& b) {
  if (Proportional(a.q, b.q)) {
    const bool one = a.q.c2 == 0 || a.upper == b.upper || DiscriminantSign(a.q) == 0;
    if (one) return 0;
    return a.upper ? 1 : -1;
  }
  const Surd r = SurdOf(a);
  const Surd t = SurdOf(b);
  // The sign of p + q sqrt(x) + k sqrt(y).
  const Int1280 p = r.a * t.d - t.a * r.d;
  const Int1280 q = Int1280(r.b) * t.d;
  const Int1280 k = Int1280(-t.b) * r.d;
  const int first = SignOfSum(p, q, r.x);
  const int second = SignOf(t.x) == 0 ? 0 : SignOf(k);
  if (first * second >= 0) return first != 0 ? first : second;
  return first * SignOfSum(p * p + q * q * r.x - k * k * t.x, (p * q) << 1, r.x);
}

// The value of q somewhere in the interval of `now`.
Interval ValueAt(const Quadratic& q, const SweepDepth& now) {
  const Interval s{now.lo, now.hi};
  return (IntervalOf(q.c2) * s + IntervalOf(q.c1)) * s + IntervalOf(q.c0);
}

}  // namespace

SweepDepth SweepDepth::At(std::int64_t s) {
  SweepDepth depth;
  depth.s = s;
  depth.lo = depth.hi = static_cast<double>(s);
  return depth;
}

int Compare(const SweepDepth& a, const SweepDepth& b) {
  if (a.hi < b.lo) return -1;
  if (a.lo > b.hi) return 1;
  if (a.whole && b.whole) return SignOf(a.s - b.s);
  if (a.whole) return -SideOf(b, a.s);
  if (b.whole) return SideOf(a, b.s);
  return CompareRoots(a, b);
}

Roots RootsOf(const Quadratic& q) {
  Roots roots;
  if (q.c2 == 0) {
    if (q.c1 == 0) return roots;
    roots.count = 1;
    roots.at[0] = RootAt(q, false, -IntervalOf(q.c0) / IntervalOf(q.c1));
    return roots;
  }
  const int discriminant = DiscriminantSign(q);
  if (discriminant < 0) return roots;
  const Interval c0 = IntervalOf(q.c0);
  const Interval c1 = IntervalOf(q.c1);
  const Interval c2 = IntervalOf(q.c2);
  const Interval half{0.5L, 0.5L};
  if (discriminant == 0) {
    roots.count = 1;
    roots.twofold = true;
    roots.at[0] = RootAt(q, false, -(c1 * half) / c2);
    return roots;
  }
  // The root in which numbers of one sign are added, and the other one from the product of the two:
  // no cancellation.
  const Interval difference = Root(c1 * c1 + -(c2 * c0 * Interval{4, 4}));
  const bool negative = q.c1 < 0;
  const Interval sum = (-c1 + (negative ? difference : -difference)) * half;
  const bool first_is_upper = negative == (q.c2 > 0);
  roots.count = 2;
  roots.at[first_is_upper ? 1 : 0] = RootAt(q, first_is_upper, sum / c2);
  roots.at[first_is_upper ? 0 : 1] = RootAt(q, !first_is_upper, c0 / sum);
  return roots;
}

int SignAfter(const Quadratic& q, const SweepDepth& now) {
  if (q.c1 == 0 && q.c2 == 0) return SignOf(q.c0);
  if (now.whole) {
    const LocalSigns at = At(q, now.s);
    if (at.value != 0) return at.value;
    return at.slope != 0 ? at.slope : SignOf(q.c2);
  }
  const Interval value = ValueAt(q, now);
  if (!HasZero(value)) return value.lo > 0 ? 1 : -1;
  const Roots roots = RootsOf(q);
  int sign = q.c2 != 0 ? SignOf(q.c2) : SignOf(q.c1);  // far beyond all roots
  if (roots.twofold) return sign;
  for (int i = 0; i < roots.count; ++i) {
    if (Compare(roots.at[static_cast<std::size_t>(i)], now) > 0) sign = -sign;
  }
  return sign;
}

std::optional<SweepDepth> FailureAfter(const Quadratic& q, const SweepDepth& now,
                                       std::int64_t end) {
  if (q.c1 == 0 && q.c2 == 0) return std::nullopt;
  const Roots roots = RootsOf(q);
  if (roots.twofold) return std::nullopt;
  for (int i = 0; i < roots.count; ++i) {
    const SweepDepth& root = roots.at[static_cast<std::size_t>(i)];
    if (Compare(root, now) <= 0) continue;
    if (Compare(root, SweepDepth::At(end)) >= 0) return std::nullopt;
    return root;
  }
  return std::nullopt;
}

}  // namespace farhorizon::kinetic

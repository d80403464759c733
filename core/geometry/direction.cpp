// Directions compared by a key in double first, then by the sign of a cross product; and the
// simplest integer vector between two of them, by a search in the Stern-Brocot tree. The code is
// one for the three sizes of numbers (vector.h), except for products, where each size has its own
// care.
#include "core/geometry/direction.h"

#include <array>
#include <cmath>

#include "core/base/result.h"

namespace farhorizon {

namespace {

constexpr Int128 kNarrow = Int128{1} << 62;

bool IsNarrow(const Vector& v) {
  return v.x < kNarrow && v.x > -kNarrow && v.y < kNarrow && v.y > -kNarrow;
}

template <typename Int>
bool StrictlyBetween(const BasicVector<Int>& from, const BasicVector<Int>& v,
                     const BasicVector<Int>& to) {
  // From and to are at most half a turn apart, so being on the right sides of both is enough.
  return CrossSign(from, v) > 0 && CrossSign(v, to) > 0;
}

// A vector that grows by repeated addition of another: base + count * step.
template <typename Int>
BasicVector<Int> Add(const BasicVector<Int>& base, const Int& count, const BasicVector<Int>& step) {
  return {base.x + count * step.x, base.y + count * step.y};
}

// The search in the Stern-Brocot tree between the axes lo and hi, a quarter turn apart, for the
// simplest vector strictly between from and to, which lie between the axes. A run of steps to one
// side is taken at once, its length found by doubling and halving.
template <typename Int>
BasicVector<Int> SternBrocot(BasicVector<Int> lo, BasicVector<Int> hi, const BasicVector<Int>& from,
                             const BasicVector<Int>& to) {
  while (true) {
    const BasicVector<Int> middle = Add(lo, Int{1}, hi);
    const bool low = CrossSign(from, middle) <= 0;
    const bool high = CrossSign(middle, to) <= 0;
    if (!low && !high) return middle;
    Check(!(low && high), "there is room between two different directions");
    // Whether lo + steps * hi (or hi + steps * lo) is still outside. The most such steps are taken.
    const auto outside = [&](const Int& steps) {
      return low ? CrossSign(from, Add(lo, steps, hi)) <= 0
                 : CrossSign(Add(hi, steps, lo), to) <= 0;
    };
    Int count{1};
    while (outside(count << 1)) count = count << 1;
    for (Int step = count >> 1; SignOf(step) > 0; step = step >> 1) {
      if (outside(count + step)) count = count + step;
    }
    if (low) {
      lo = Add(lo, count, hi);
    } else {
      hi = Add(hi, count, lo);
    }
  }
}

template <typename Int>
BasicVector<Int> SimplestInside(const BasicVector<Int>& from, const BasicVector<Int>& to) {
  const Int one{1};
  const Int zero{0};
  const std::array<BasicVector<Int>, 4> axes = {
      {{one, zero}, {zero, one}, {-one, zero}, {zero, -one}}};
  for (const BasicVector<Int>& axis : axes) {
    if (StrictlyBetween(from, axis, to)) return axis;
  }
  for (std::size_t i = 0; i < 4; ++i) {
    const BasicVector<Int>& lo = axes[i];
    const BasicVector<Int>& hi = axes[(i + 1) % 4];
    // No axis is strictly between, so from and to lie in one closed quarter.
    const auto within = [&](const BasicVector<Int>& v) {
      return CrossSign(lo, v) >= 0 && CrossSign(v, hi) >= 0;
    };
    if (within(from) && within(to)) return SternBrocot(lo, hi, from, to);
  }
  throw InternalError("two directions without an axis between them lie in one quarter");
}

template <typename Int>
BasicDirection<Int> DirectionOf(const BasicVector<Int>& v) {
  BasicDirection<Int> d;
  const int up = SignOf(v.y);
  d.turned = up < 0 || (up == 0 && SignOf(v.x) < 0);
  d.v = d.turned ? -v : v;
  // With u = 2^-53: each conversion is off by 2u at most, sum, quotient and difference by u. So the
  // denominator is off by 3u of itself, the quotient by 2u + 3u + u, as |x| <= |x| + y, and the key
  // by 7u, less than 2^-50.
  const auto x = static_cast<double>(d.v.x);
  const auto y = static_cast<double>(d.v.y);
  d.key = 1 - x / (std::abs(x) + y);
  return d;
}

template <typename Int>
int AngleSign(const BasicDirection<Int>& a, const BasicDirection<Int>& b, PredicateCounts* counts) {
  // Each key is off by less than 2^-50.
  const double difference = a.key - b.key;
  if (std::abs(difference) > 0x1p-49) {
    if (counts != nullptr) ++counts->filtered;
    return difference > 0 ? 1 : -1;
  }
  const int sign = -CrossSign(a.v, b.v);
  if (counts != nullptr) ++(sign == 0 ? counts->tied : counts->exact);
  return sign;
}

template <typename Int>
BasicVector<Int> SimplestNotAlong(const BasicVector<Int>& from, const BasicVector<Int>& to,
                                  const BasicVector<Int>& along) {
  const BasicVector<Int> simplest = SimplestInside(from, to);
  return CrossSign(simplest, along) == 0 ? SimplestInside(from, simplest) : simplest;
}

}  // namespace

int CrossSign(const ShortVector& a, const ShortVector& b) {
  return SignOf(Int128{a.x} * b.y - Int128{a.y} * b.x);
}

int DotSign(const ShortVector& a, const ShortVector& b) {
  return SignOf(Int128{a.x} * b.x + Int128{a.y} * b.y);
}

int CrossSign(const Vector& a, const Vector& b) {
  if (IsNarrow(a) && IsNarrow(b)) return SignOf(Cross(a, b));
  return CompareProducts(a.x, b.y, a.y, b.x);
}

int DotSign(const Vector& a, const Vector& b) {
  if (IsNarrow(a) && IsNarrow(b)) return SignOf(Dot(a, b));
  return CompareProducts(a.x, b.x, -a.y, b.y);
}

int CrossSign(const WideVector& a, const WideVector& b) { return SignOf(Cross(a, b)); }
int DotSign(const WideVector& a, const WideVector& b) { return SignOf(Dot(a, b)); }

ShortDirection MakeDirection(const ShortVector& v) { return DirectionOf(v); }
Direction MakeDirection(const Vector& v) { return DirectionOf(v); }
WideDirection MakeDirection(const WideVector& v) { return DirectionOf(v); }

int CompareAngle(const ShortDirection& a, const ShortDirection& b, PredicateCounts* counts) {
  return AngleSign(a, b, counts);
}
int CompareAngle(const Direction& a, const Direction& b, PredicateCounts* counts) {
  return AngleSign(a, b, counts);
}
int CompareAngle(const WideDirection& a, const WideDirection& b, PredicateCounts* counts) {
  return AngleSign(a, b, counts);
}

ShortVector SimplestBetween(const ShortVector& from, const ShortVector& to,
                            const ShortVector& along) {
  return SimplestNotAlong(from, to, along);
}
Vector SimplestBetween(const Vector& from, const Vector& to, const Vector& along) {
  return SimplestNotAlong(from, to, along);
}
WideVector SimplestBetween(const WideVector& from, const WideVector& to, const WideVector& along) {
  return SimplestNotAlong(from, to, along);
}

}  // namespace farhorizon

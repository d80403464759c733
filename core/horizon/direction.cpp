#include "core/horizon/direction.h"

#include <array>
#include <cmath>
#include <optional>

#include "core/base/result.h"

namespace farhorizon {
namespace {

constexpr Int128 kNarrow = Int128{1} << 62;

bool IsNarrow(const Vector& v) {
  return v.x < kNarrow && v.x > -kNarrow && v.y < kNarrow && v.y > -kNarrow;
}

bool StrictlyBetween(const Vector& from, const Vector& v, const Vector& to) {
  // From and to are at most half a turn apart, so being on the right sides of both is enough.
  return CrossSign(from, v) > 0 && CrossSign(v, to) > 0;
}

// A vector that grows by repeated addition of another: base + count * step.
Vector Add(const Vector& base, Int128 count, const Vector& step) {
  return {base.x + count * step.x, base.y + count * step.y};
}

// The Stern-Brocot search between the axes lo and hi, a quarter turn apart, for the simplest vector
// strictly between from and to, which lie between them. Runs of steps to one side are galloped.
Vector SternBrocot(Vector lo, Vector hi, const Vector& from, const Vector& to) {
  while (true) {
    const Vector middle = Add(lo, 1, hi);
    const bool low = CrossSign(from, middle) <= 0;
    const bool high = CrossSign(middle, to) <= 0;
    if (!low && !high) return middle;
    Check(!(low && high), "there is room between two different directions");
    // The furthest lo + count * hi (or hi + count * lo) that is still outside.
    const auto outside = [&](Int128 count) {
      return low ? CrossSign(from, Add(lo, count, hi)) <= 0
                 : CrossSign(Add(hi, count, lo), to) <= 0;
    };
    Int128 reach = 1;
    while (outside(2 * reach)) reach *= 2;
    for (Int128 step = reach / 2; step > 0; step /= 2) {
      if (outside(reach + step)) reach += step;
    }
    if (low) {
      lo = Add(lo, reach, hi);
    } else {
      hi = Add(hi, reach, lo);
    }
  }
}

Vector SimplestInside(const Vector& from, const Vector& to) {
  const std::array<Vector, 8> around = {
      {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
  for (std::size_t i = 0; i < 8; i += 2) {
    if (StrictlyBetween(from, around[i], to)) return around[i];
  }
  for (std::size_t i = 0; i < 8; i += 2) {
    const Vector& lo = around[i];
    const Vector& hi = around[(i + 2) % 8];
    // No axis is strictly between, so from and to lie in one closed quarter.
    const auto within = [&](const Vector& v) {
      return CrossSign(lo, v) >= 0 && CrossSign(v, hi) >= 0;
    };
    if (within(from) && within(to)) return SternBrocot(lo, hi, from, to);
  }
  throw InternalError("two directions without an axis between them lie in one quarter");
}

}  // namespace

int CrossSign(const Vector& a, const Vector& b) {
  if (IsNarrow(a) && IsNarrow(b)) return SignOf(a.x * b.y - a.y * b.x);
  return CompareProducts(a.x, b.y, a.y, b.x);
}

int DotSign(const Vector& a, const Vector& b) {
  if (IsNarrow(a) && IsNarrow(b)) return SignOf(a.x * b.x + a.y * b.y);
  return CompareProducts(a.x, b.x, -a.y, b.y);
}

Direction MakeDirection(const Vector& v) {
  Direction d;
  d.turned = v.y < 0 || (v.y == 0 && v.x < 0);
  d.v = d.turned ? -v : v;
  // Both conversions, the sum and the quotient are within half a unit in the last place each.
  const double x = static_cast<double>(d.v.x);
  const double y = static_cast<double>(d.v.y);
  d.key = 1 - x / (std::abs(x) + y);
  return d;
}

Direction FirstDirection() { return {{1, 0}, 0, false}; }
Direction LastDirection() { return {{-1, 0}, 2, false}; }

int CompareAngle(const Direction& a, const Direction& b, PredicateCounts* counts) {
  const double difference = a.key - b.key;
  if (std::abs(difference) > 0x1p-49) {
    if (counts != nullptr) ++counts->filtered;
    return difference > 0 ? 1 : -1;
  }
  const int sign = -CrossSign(a.v, b.v);
  if (counts != nullptr) ++(sign == 0 ? counts->tied : counts->exact);
  return sign;
}

Vector SimplestBetween(const Vector& from, const Vector& to, const Vector& along) {
  Vector simplest = SimplestInside(from, to);
  if (CrossSign(simplest, along) == 0) simplest = SimplestInside(from, simplest);
  return simplest;
}

}  // namespace farhorizon

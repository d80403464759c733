#pragma once

#include <cstdint>

#include "core/exact/quadratic.h"
#include "core/geometry/vector.h"

namespace farhorizon {

/// The vector (ax + bx t, ay + by t): a direction that turns while a point moves along a segment.
///
/// Limits: |a|, |b| < 2^50. Those of a TargetSegment are sums of two products of a plan difference,
/// at most 17 bits, and a difference of heights, at most 31 bits.
struct MovingVector {
  std::int64_t ax = 0;
  std::int64_t ay = 0;
  std::int64_t bx = 0;
  std::int64_t by = 0;

  /// The vector at t, times 2^k.
  template <typename Int>
  [[nodiscard]] BasicVector<Int> At(const BasicDyadic<Int>& t) const {
    return {(Int{ax} << t.k) + Int{bx} * t.n, (Int{ay} << t.k) + Int{by} * t.n};
  }
  [[nodiscard]] bool IsZero() const { return ax == 0 && ay == 0 && bx == 0 && by == 0; }
  friend bool operator==(const MovingVector&, const MovingVector&) = default;
};

/// Cross and dot product, as polynomials in t.
Quadratic Cross(const MovingVector& a, const MovingVector& b);
Quadratic Dot(const MovingVector& a, const MovingVector& b);

}  // namespace farhorizon

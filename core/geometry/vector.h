#pragma once

#include <cstdint>

#include "core/exact/int128.h"
#include "core/exact/int1280.h"

namespace farhorizon {

/// A vector in the plan, (columns, rows).
///
/// Exact ones come in three sizes of numbers: 64 bits for most points, in which components are
/// below 2^62; 128 bits; and wide ones for the few points of great cliffs that need them.
template <typename Number>
struct BasicVector {
  Number x{};
  Number y{};

  [[nodiscard]] bool IsZero() const { return SignOf(x) == 0 && SignOf(y) == 0; }
  BasicVector operator-() const { return {-x, -y}; }
};
using ShortVector = BasicVector<std::int64_t>;
using Vector = BasicVector<Int128>;
using WideVector = BasicVector<Int1280>;
/// In floating point.
using PlanVector = BasicVector<double>;

/// The cross product, positive where b is counter-clockwise of a within half a turn: in the sense
/// from
/// columns to rows, as plan.h draws it.
/// Requires: a Number holds it. (CrossSign in direction.h has no such condition.)
template <typename Number>
Number Cross(const BasicVector<Number>& a, const BasicVector<Number>& b) {
  return a.x * b.y - a.y * b.x;
}

/// The dot product. Requires: as for Cross.
template <typename Number>
Number Dot(const BasicVector<Number>& a, const BasicVector<Number>& b) {
  return a.x * b.x + a.y * b.y;
}

}  // namespace farhorizon

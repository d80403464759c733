#pragma once

#include "core/exact/predicate_counts.h"
#include "core/geometry/vector.h"

namespace farhorizon {

/// The sign of the cross product: 1 where b is counter-clockwise of a within half a turn.
int CrossSign(const ShortVector& a, const ShortVector& b);
int CrossSign(const Vector& a, const Vector& b);
int CrossSign(const WideVector& a, const WideVector& b);
/// The sign of the dot product.
int DotSign(const ShortVector& a, const ShortVector& b);
int DotSign(const Vector& a, const Vector& b);
int DotSign(const WideVector& a, const WideVector& b);

/// A direction of sight: a vector without a sense, stored as that one of the two that lies in the
/// half turn [0, 180) degrees from the x axis. Ordered by that angle.
template <typename Int>
struct BasicDirection {
  BasicVector<Int> v;
  double key = 0;       ///< rises with the angle from 0 to 2, as 1 - cosine does; off by < 2^-50
  bool turned = false;  ///< v is the opposite of what it was made from
};
using ShortDirection = BasicDirection<std::int64_t>;
using Direction = BasicDirection<Int128>;
using WideDirection = BasicDirection<Int1280>;

/// Requires: `v` is not zero.
ShortDirection MakeDirection(const ShortVector& v);
Direction MakeDirection(const Vector& v);
WideDirection MakeDirection(const WideVector& v);

/// The two ends of the half turn: one direction, at the angles 0 and 180 degrees.
template <typename Int = Int128>
BasicDirection<Int> FirstDirection() {
  return {{Int{1}, Int{0}}, 0, false};
}
template <typename Int = Int128>
BasicDirection<Int> LastDirection() {
  return {{Int{-1}, Int{0}}, 2, false};
}

/// -1, 0, 1 as the angle of a is less than, equal to, greater than that of b. Exact: the keys
/// decide where they differ by more than their errors, a cross product elsewhere.
int CompareAngle(const ShortDirection& a, const ShortDirection& b, PredicateCounts* counts);
int CompareAngle(const Direction& a, const Direction& b, PredicateCounts* counts);
int CompareAngle(const WideDirection& a, const WideDirection& b, PredicateCounts* counts);

/// The simplest integer vector strictly between from and to, counter-clockwise: an axis, or the
/// first one in the Stern-Brocot tree of a quarter. If it is parallel to `along`, the simplest one
/// between `from` and that.
/// Requires: cross(from, to) > 0, or from = -to.
ShortVector SimplestBetween(const ShortVector& from, const ShortVector& to,
                            const ShortVector& along);
Vector SimplestBetween(const Vector& from, const Vector& to, const Vector& along);
WideVector SimplestBetween(const WideVector& from, const WideVector& to, const WideVector& along);

}  // namespace farhorizon

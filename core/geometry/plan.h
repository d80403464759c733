#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "core/exact/int128.h"
#include "core/geometry/point.h"
#include "core/geometry/vector.h"

namespace farhorizon {

// Signed areas come in two senses. For lines, directions and hulls the plan is (column, row), where
// counter-clockwise is from columns to rows; for triangles of a mesh it is (column, -row), where
// counter-clockwise is as the ground is seen from above.
//
//          row ^    b                      o----------> column
//              |   /                       | ` ` .
//              |  /    . a                 |  `    ` a
//              | /  . `                    |   `
//              o----------> column     row v    b
//
//           Cross(o, a, b) > 0         TwiceArea(o, a, b) < 0

/// The cross product of the vectors from o to a and from o to b, columns and rows: positive where a
/// turn from a to b, less than half a one, is from columns to rows. Exact.
inline std::int64_t Cross(Point2i o, Point2i a, Point2i b) {
  return Cross(ShortVector{a.x - o.x, a.y - o.y}, ShortVector{b.x - o.x, b.y - o.y});
}

/// Twice the signed area of the triangle o, p, q in the plan (column, -row): positive where it runs
/// counter-clockwise as the ground is seen from above. Exact: grids have at most 2^15 columns and
/// rows.
inline std::int64_t TwiceArea(Point3i o, Point3i p, Point3i q) {
  return -Cross({o.x, o.y}, {p.x, p.y}, {q.x, q.y});
}

/// Square of the distance in plan, columns and rows.
inline std::int64_t SquaredLength(Point3i p, Point3i q) {
  const std::int64_t dx = q.x - p.x;
  const std::int64_t dy = q.y - p.y;
  return dx * dx + dy * dy;
}

/// The steepest rise of a triangle along the axes of the grid: quanta a column, quanta a row.
struct Slope {
  double by_column = 0;
  double by_row = 0;
};

inline constexpr Slope kAnySlope = {std::numeric_limits<double>::infinity(),
                                    std::numeric_limits<double>::infinity()};

/// Sizes only, no signs. Requires: a, b, c turn counter-clockwise in plan.
inline Slope SlopeOf(Point3i a, Point3i b, Point3i c) {
  const auto area = static_cast<double>(TwiceArea(a, b, c));
  const double rise_b = static_cast<double>(b.z) - a.z;
  const double rise_c = static_cast<double>(c.z) - a.z;
  return {std::abs(rise_b * (c.y - a.y) - rise_c * (b.y - a.y)) / area,
          std::abs(rise_b * (c.x - a.x) - rise_c * (b.x - a.x)) / area};
}

/// Sign of the height of the segment v, w over the segment p, q where they cross in plan.
/// Requires: they cross, and q is on the left of p as seen from v: TwiceArea(v, p, q) > 0. Exact.
inline int SideAtCrossing(Point3i v, Point3i w, Point3i p, Point3i q) {
  // Weights of p and q at the crossing, by the line v, w; then of v and w, by the line p, q.
  const std::int64_t of_p = TwiceArea(v, w, q);
  const std::int64_t of_q = TwiceArea(v, p, w);
  const std::int64_t of_w = TwiceArea(v, p, q);
  const std::int64_t of_v = -TwiceArea(w, p, q);
  const Int128 under = Int128{of_p} * p.z + Int128{of_q} * q.z;  // times of_v + of_w
  const Int128 over = Int128{of_v} * v.z + Int128{of_w} * w.z;   // times of_p + of_q
  const Int128 difference = over * (of_p + of_q) - under * (of_v + of_w);
  return SignOf(difference);
}

/// Above the line through c and d (1), in one plane with it (0) or below it (-1): whether the edge
/// from a to b is a ridge between the faces whose third posts are c and d, however large they are.
/// Requires: c on the left, d on the right of ab in plan. Exact.
inline int RidgeSign(Point3i a, Point3i b, Point3i c, Point3i d) {
  const std::int64_t of_d = TwiceArea(a, b, c);  // > 0
  const std::int64_t of_c = -TwiceArea(a, b, d);
  const std::int64_t of_b = TwiceArea(a, d, c);  // may be negative: the line may miss the edge
  const std::int64_t of_a = of_c + of_d - of_b;
  return SignOf(Int128{of_a} * a.z + Int128{of_b} * b.z - Int128{of_c} * c.z - Int128{of_d} * d.z);
}

}  // namespace farhorizon

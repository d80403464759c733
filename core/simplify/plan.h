#pragma once

#include <cstdint>

#include "core/terrain/terrain.h"

namespace farhorizon {

/// Twice the signed area of the triangle o, p, q in the plan (column, -row): positive where it runs
/// counter-clockwise as the ground is seen from above. Exact: grids have at most 2^15 columns and
/// rows.
inline std::int64_t TwiceArea(Point3i o, Point3i p, Point3i q) {
  const std::int64_t px = p.x - o.x;
  const std::int64_t py = p.y - o.y;
  const std::int64_t qx = q.x - o.x;
  const std::int64_t qy = q.y - o.y;
  return py * qx - px * qy;
}

/// Square of the distance in plan, columns and rows.
inline std::int64_t SquaredLength(Point3i p, Point3i q) {
  const std::int64_t dx = q.x - p.x;
  const std::int64_t dy = q.y - p.y;
  return dx * dx + dy * dy;
}

}  // namespace farhorizon

#pragma once

#include <cstdint>

namespace farhorizon {

/// Where a vertex of a level is: a post in plan, and its height, metres above Ground::base_m, over
/// the plan and in the tile's frame, where the mesh's triangles are flat.
struct Place {
  std::int16_t x = 0;  ///< column
  std::int16_t y = 0;  ///< row
  float plan = 0;
  float frame = 0;
};

/// Twice the signed area of abc in plan; positive where the corners turn from columns to rows, as
/// the triangles of a HalfEdgeMesh do.
inline std::int64_t Turn(const Place& a, const Place& b, const Place& c) {
  return std::int64_t{b.x - a.x} * (c.y - a.y) - std::int64_t{c.x - a.x} * (b.y - a.y);
}

}  // namespace farhorizon

#pragma once

#include <algorithm>
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

/// Whether triangle abc turns, and is not so thin that rounding to a lattice of a 16th of a cell,
/// or a grid that is bent in space, could turn it over: its least altitude is a tenth of a cell and
/// a 256th of its longest side, or more. All triangles of a grid are sound.
inline bool IsSound(const Place& a, const Place& b, const Place& c) {
  const std::int64_t turn = Turn(a, b, c);
  const auto squared = [](const Place& p, const Place& q) {
    const std::int64_t dx = q.x - p.x;
    const std::int64_t dy = q.y - p.y;
    return dx * dx + dy * dy;
  };
  const std::int64_t longest = std::max({squared(a, b), squared(b, c), squared(c, a)});
  return turn > 0 && 100 * turn * turn >= longest && 256 * turn >= longest;
}

}  // namespace farhorizon

#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/base/result.h"

namespace farhorizon {

/// A point of the globe's lattice in longitude and latitude.
struct LatticePoint {
  std::int64_t x = 0;
  std::int64_t y = 0;
  friend auto operator<=>(const LatticePoint&, const LatticePoint&) = default;
};

/// 1 where triangle abc is counter-clockwise, -1 where it is clockwise, 0 where it is flat. Exact.
/// Requires: coordinates differ by less than 2^62.
int Orientation(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c);

/// Triangulates what `edges` enclose: all points from which a ray crosses an odd number of them.
/// The corners of the triangles are ends of edges, and each edge is a side of one triangle.
///
/// edges: pairs of `points`, in either order. Result: counter-clockwise, by `points`.
/// Requires: points differ.
/// Errors: kUnsupportedData, kind "bad-mesh", where edges cross, overlap or do not close.
/// Cost: O(n log n).
Result<std::vector<std::array<std::uint32_t, 3>>> TriangulateInside(
    const std::vector<LatticePoint>& points,
    const std::vector<std::array<std::uint32_t, 2>>& edges);

}  // namespace farhorizon

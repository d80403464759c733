#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/terrain/mesh.h"

namespace farhorizon {

/// No triangle, or no side.
inline constexpr std::int32_t kNoneThere = -1;

/// A side of triangles of a mesh, between two of its points, a < b.
///
/// left: the triangle that runs from a to b, which is on the left of a -> b; right: the one that
/// runs from b to a; kNoneThere where there is none.
struct MeshSide {
  std::int32_t a = 0;
  std::int32_t b = 0;
  std::int32_t left = kNoneThere;
  std::int32_t right = kNoneThere;

  [[nodiscard]] bool IsOutline() const { return left == kNoneThere || right == kNoneThere; }
  /// The other triangle at this side.
  [[nodiscard]] std::int32_t Beyond(std::int32_t triangle) const {
    return triangle == left ? right : left;
  }
};

/// The sides of a mesh, and which triangle has which.
///
/// sides: rising by (a, b). Where two triangles lie on one side of an edge, each surplus one has a
///   record of its own, as if the mesh ended there.
/// of_triangle: n_triangles x 3; entry k is the side opposite to the triangle's point k.
/// crowded: how many surplus records there are.
struct MeshSides {
  std::vector<MeshSide> sides;
  std::vector<std::array<std::int32_t, 3>> of_triangle;
  std::int64_t crowded = 0;
};

/// Requires: triangles name points of the mesh, each three different ones.
/// Cost: O(n log d), d the sides at a point.
MeshSides SidesOf(const GridMesh& mesh);

/// Whether the surface bends down at the side, or may within rounding, or ends there. A line's
/// highest ground is over such a side: beside any other, ground on it is at least as high.
bool IsRidgeOrOutline(const GridMesh& mesh, const MeshSide& side);

}  // namespace farhorizon

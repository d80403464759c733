#pragma once

#include <optional>
#include <vector>

#include "core/terrain/mesh.h"

namespace farhorizon {

/// An edge of a mesh over posts, and the third posts of the triangles on either side of it.
struct MeshEdge {
  Edge edge;
  std::optional<VertexId> left;  ///< of a -> b
  std::optional<VertexId> right;
};

/// Every edge of `triangles` once, in ascending order of (a, b); nullopt where two triangles lie on
/// the same side of one edge.
/// Cost: O(n log n).
std::optional<std::vector<MeshEdge>> EdgesOf(const std::vector<Triangle>& triangles);

}  // namespace farhorizon

#pragma once

#include <optional>
#include <vector>

#include "core/terrain/mesh.h"

namespace farhorizon {

/// A side of triangles over posts, and the third posts of those on either side of it.
struct MeshEdge {
  Edge edge;
  std::optional<VertexId> left;  ///< of a -> b
  std::optional<VertexId> right;
};

/// Every edge of `triangles` once, by rising (a, b); nullopt where a directed side stands twice.
/// Cost: O(n log n).
std::optional<std::vector<MeshEdge>> EdgesOf(const std::vector<Triangle>& triangles);

}  // namespace farhorizon

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "core/io/local_mesh.h"

namespace farhorizon {

/// The data of EXT_mesh_primitive_edge_visibility for a set of edges of a mesh.
struct EdgeVisibility {
  /// Two bits for each side v0v1, v1v2, v2v0 of each triangle in turn, lowest bits first: 0 hidden,
  /// 1 silhouette (drawn between a front and a back face), 2 hard (always drawn).
  std::vector<std::uint8_t> bits;
  /// The unit normals of both triangles at each silhouette edge, in the order of `bits`: two
  /// triples x, y, z of signed bytes, 127 for 1.
  std::vector<std::int8_t> normals;
  std::int64_t edge_count = 0;

  friend bool operator==(const EdgeVisibility&, const EdgeVisibility&) = default;
};

/// Flags `edges` (pairs of vertices): those between two triangles as silhouette edges, those on the
/// border as hard edges, because they have no second face to be a silhouette against.
///
/// Vertices of equal post and position count as one (Draco splits a vertex between its fans).
/// Each edge is flagged once, at its first triangle. Pairs that are no edge of the mesh are left
/// out.
/// Cost: O(n log n).
EdgeVisibility FlagEdges(const LocalMesh& mesh,
                         const std::vector<std::pair<std::uint32_t, std::uint32_t>>& edges);

/// What `edges` says of a mesh, for parts that have its triangles in turn, so many each. An edge
/// between two parts is flagged in the first of them, with the normals of both.
/// Requires: the parts have all triangles.
std::vector<EdgeVisibility> SplitEdges(const EdgeVisibility& edges,
                                       const std::vector<std::size_t>& triangles);
/// The opposite: of parts that have so many triangles each, what they say of all in turn. A part
/// without bits flags nothing. nullopt where one has bits or normals for more or fewer triangles.
/// Flagged edges are counted anew.
std::optional<EdgeVisibility> JoinEdges(const std::vector<EdgeVisibility>& parts,
                                        const std::vector<std::size_t>& triangles);

}  // namespace farhorizon

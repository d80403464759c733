#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/terrain/dem.h"

namespace farhorizon {

/// A triangle by its three posts, counter-clockwise in the plan (column, -row): on the map, with
/// columns to the right and rows downwards, as the ground is seen from above.
using Triangle = std::array<VertexId, 3>;

/// An edge by its two posts, a < b.
struct Edge {
  VertexId a = 0;
  VertexId b = 0;
  friend auto operator<=>(const Edge&, const Edge&) = default;
};

/// The edge between two posts, in whichever order they are given.
inline Edge MakeEdge(VertexId p, VertexId q) { return p < q ? Edge{p, q} : Edge{q, p}; }

/// A triangulated surface over posts of a DEM: what a level of detail is before it is encoded.
///
/// Its vertices are posts in plan; their heights are the mesh's own.
/// posts: the vertices, rising. heights_m: for each of them, metres, in the DEM's height system.
/// triangles: by posts.
struct PostMesh {
  std::vector<VertexId> posts;
  std::vector<double> heights_m;
  std::vector<Triangle> triangles;
};

/// A point of a mesh in the frame of the grid: fractional column and row, height in metres.
struct GridPoint {
  double column = 0;
  double row = 0;
  double height_m = 0;
};

/// Any mesh in the frame of the grid, such as that of a decoded artifact.
/// indices: n_triangles x 3 into `points`, counter-clockwise as in Triangle.
struct GridMesh {
  std::vector<GridPoint> points;
  std::vector<std::array<std::int32_t, 3>> triangles;
};

}  // namespace farhorizon

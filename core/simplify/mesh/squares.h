#pragma once

#include <limits>

#include "core/simplify/mesh/ground.h"
#include "core/simplify/mesh/place.h"

namespace farhorizon {

/// How far posts are from a mesh, summed triangle by triangle.
///
/// Rows and columns are half open, as in rasterising, so that triangles which tile the plan share
/// the posts out: a triangle has its left and upper edges. What is left over, the posts on the
/// rim's right and lower edges, belongs to the rim's edges (RimSquares).
/// All in floats, square metres, in the tile's frame. Cost: the posts under the triangle.

/// Sum over the posts of triangle abc of (ground - triangle)^2; infinity where one of them is off
/// by more than `most_m`. Requires: Turn(a, b, c) > 0.
float Squares(const Ground& ground, const Place& a, const Place& b, const Place& c,
              float most_m = std::numeric_limits<float>::infinity());

/// What a change dz of one vertex's height does to a sum of squares:
/// -2 dz pull + dz^2 stiffness.
struct HeightPull {
  float pull = 0;
  float stiffness = 0;
};
/// The same for a's height over the posts of triangle abc, added to `sum`.
void AddPull(const Ground& ground, const Place& a, const Place& b, const Place& c, HeightPull& sum);

/// Sum over the posts of the rim's edge from a, inclusive, to b, exclusive, that no triangle has;
/// 0 where triangles have them. The mesh lies on the side of positive turns of a -> b. infinity as
/// for Squares. Requires: the edge runs along steps of one column, one row or both.
float RimSquares(const Ground& ground, const Place& a, const Place& b,
                 float most_m = std::numeric_limits<float>::infinity());

}  // namespace farhorizon

#pragma once

#include <limits>

#include "core/simplify/mesh/ground.h"
#include "core/simplify/mesh/place.h"

namespace farhorizon {

/// A sum of squares by a change dz of one vertex's height: sum - 2 dz pull + dz^2 stiffness.
struct HeightPull {
  float pull = 0;
  float stiffness = 0;
  float sum = 0;
};

/// How far posts are from a mesh, and facets from the ground's, summed triangle by triangle:
///   (ground - triangle)^2                                              over the posts under it
///   + slope_weight / 2 |gradient of a facet - gradient of the triangle|^2     over the centroids
///     under it of the ground's facets, two a cell (Terrain),
/// gradients in metres a cell. The second term asks for facets that lie as the ground does, which
/// light shows, and so for no needles. It is the integral over the plan of the squared gradient of
/// (mesh - ground), where each facet of the ground counts as lying under the triangle that has its
/// centroid. So it is 0 for the ground's own triangles, and heights fitted to it go towards theirs.
/// Differences of posts taken at another place, or across the other diagonal, are gradients of
/// facets that the ground has not there: fine meshes would be drawn away from it.
///
/// Posts and centroids are shared out half open, as in rasterising, so that triangles which tile
/// the plan have each once: a triangle has its left and upper edges. What is left over, the posts
/// on the rim's right and lower edges, belongs to the rim's edges, but for corners of the rim whose
/// triangles all lie above them or to their left.
/// All in floats, square metres, in the tile's frame.
class PostSquares {
 public:
  /// Requires: `ground` outlives it.
  explicit PostSquares(const Ground& ground) : ground_(&ground) {}

  /// Square cells that a squared gradient is worth.
  void SetSlopeWeight(float weight) { slope_weight_ = weight; }
  /// What a post may be off, metres: a sum is infinite where one is off by more.
  void SetMost(float most_m) { most_ = most_m * most_m; }

  /// The sum over triangle abc. Requires: Turn(a, b, c) > 0. Cost: the posts and cells under it.
  [[nodiscard]] float Of(const Place& a, const Place& b, const Place& c) const;
  /// Adds the sum over triangle abc by a's height to `pull`, whatever posts may be off.
  void AddPull(const Place& a, const Place& b, const Place& c, HeightPull& pull) const;
  /// The sum over the posts of the rim's edge from a, inclusive, to b, exclusive, that no triangle
  /// has; 0 where triangles have them. The mesh lies on the side of positive turns of a -> b.
  /// Requires: the edge runs along steps of one column, one row or both.
  [[nodiscard]] float OfRim(const Place& a, const Place& b) const;

 private:
  const Ground* ground_;
  float slope_weight_ = 0;
  float most_ = std::numeric_limits<float>::infinity();  // squared
};

}  // namespace farhorizon

#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "core/geometry/plan.h"
#include "core/simplify/posts_by_triangle.h"
#include "core/simplify/surface.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// Limits on the triangles of a level: their error at posts, and their shape.
struct TriangleLimits {
  double vertical_error = 0;  ///< at every post, quanta
  double longest_edge = 0;    ///< in plan, columns or rows; 0: any
  double least_altitude = 0;  ///< in plan, columns or rows
  Slope steepest = kAnySlope;
};

/// The triangles around one vertex, its centre, and the posts under them, for trying collapses.
///
/// The centre v is moved onto its neighbour b. The two triangles with the edge vb vanish; each of
/// the others, (v, w, x), becomes (b, w, x). These are the fan. It covers the star exactly if all
/// of its triangles turn counter-clockwise and their areas add up to the star's.
///
///         n4 ---- n3                n4 ---- n3
///        /  \    /  \              /     _/  \        the fan: (b, n1, n2), (b, n2, n3),
///       /    \  /    \            /    _/     \                (b, n3, n4), (b, n4, n5)
///     n5 ---- v ---- n2   ==>   n5   _/  ___- n2
///       \    /  \    /           |  / __--    /
///        \  /    \  /            | /__-      /
///         b ---- n1              b -------- n1
///
/// One object serves a whole run: Gather fills it anew and allocates only while it grows.
class Star {
 public:
  /// The cost of a collapse that is not allowed.
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  /// A triangle (v, w, x) of the star, v being the centre.
  struct StarTriangle {
    TriangleId id;
    VertexId w;
    VertexId x;
    Point3i w_at;
    Point3i x_at;
  };

  explicit Star(const Terrain& terrain) : terrain_(&terrain) {}

  void Gather(const Surface& surface, const PostsByTriangle& posts, VertexId v);

  [[nodiscard]] const std::vector<StarTriangle>& triangles() const { return triangles_; }
  /// The neighbours of the centre, each once.
  [[nodiscard]] const std::vector<VertexId>& neighbours() const { return neighbours_; }

  /// The increase of the sum of squared vertical errors if the centre is moved onto its neighbour
  /// `b`. kNever where a triangle would flip, vanish, or be outside `limits`, where the outline of
  /// the surface would change, or where the increase is `bound` or more. The error at a post is
  /// within one rounding of a double. Cost: O(triangles x posts).
  double CostOfCollapse(VertexId b, const TriangleLimits& limits, double bound);

  /// Assigns the posts under the star and its centre to the triangles of the fan around `b`.
  /// Requires: the last call was CostOfCollapse(b, …) and gave a cost; the surface has not yet
  /// collapsed.
  void DistributePosts(VertexId b, PostsByTriangle& posts) const;

  /// Whether the edge that would join the neighbours b and n is nowhere above the present surface;
  /// it then occludes nothing that is visible now. Exact. Requires: the edge lies within the star.
  [[nodiscard]] bool IsBelowSurface(VertexId b, VertexId n) const;

  /// Appends the neighbours to which an edge from `b` would be new.
  void NewNeighbours(VertexId b, std::vector<VertexId>& others) const;

 private:
  // A triangle (b, w, x) of the fan; w and x relative to b.
  struct FanTriangle {
    std::int64_t wx, wy, wz;
    std::int64_t xx, xy, xz;
    std::int64_t twice_area;
    TriangleId id;  // that of (v, w, x)
  };
  [[nodiscard]] bool BuildFan(VertexId b, const TriangleLimits& limits);
  // Whether the outline of the surface would change: a centre on it may be moved along it only.
  [[nodiscard]] bool ChangesOutline(VertexId b) const;
  [[nodiscard]] static bool WithinShape(const StarTriangle& triangle, Point3i b,
                                        std::int64_t twice_area, const TriangleLimits& limits);
  // The error at a post under the fan, and the triangle of the fan over it; kNever and null where
  // there is none.
  struct Fit {
    double error;
    const FanTriangle* triangle;
  };
  [[nodiscard]] Fit FitPost(Point3i post) const;

  struct Post {
    Point3i at;
    VertexId id;
  };

  const Terrain* terrain_;
  VertexId centre_ = -1;
  std::vector<StarTriangle> triangles_;
  std::vector<VertexId> neighbours_;
  std::vector<Post> posts_;  // under the star, its centre among them
  std::int64_t twice_area_ = 0;
  double squares_ = 0;  // sum of the squared errors under the present triangles

  std::vector<FanTriangle> fan_;
  Point3i target_;  // the post onto which the centre would be moved, the centre of the fan
};

}  // namespace farhorizon

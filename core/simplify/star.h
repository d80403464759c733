#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "core/geometry/plan.h"
#include "core/simplify/posts_by_triangle.h"
#include "core/simplify/surface.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// What a triangle of a level may look like and how far it may be from the posts under it.
struct TriangleLimits {
  double vertical_error = 0;  ///< at every post, quanta
  double longest_edge = 0;    ///< in plan, columns or rows; 0: any
  double least_altitude = 0;  ///< in plan, columns or rows
  Slope steepest = kAnySlope;
};

/// The triangles around one vertex with the posts under them, laid out for trying collapses.
///
/// One object serves a whole run: Gather fills it anew and allocates only while it grows.
class Star {
 public:
  /// Stands for "not allowed".
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  /// A side of the star's outline, seen from the vertex: the triangle (v, w, x).
  struct Side {
    TriangleId triangle;
    VertexId w;
    VertexId x;
    Point3i w_at;
    Point3i x_at;
  };

  explicit Star(const Terrain& terrain) : terrain_(&terrain) {}

  void Gather(const Surface& surface, const Coverage& coverage, VertexId v);

  [[nodiscard]] VertexId centre() const { return centre_; }
  [[nodiscard]] const std::vector<Side>& sides() const { return sides_; }
  /// The neighbours of the centre, each once, in the order in which they were met.
  [[nodiscard]] const std::vector<VertexId>& neighbours() const { return neighbours_; }

  /// What moving the centre onto its neighbour `b` adds to the sum of squared vertical errors;
  /// kNever where a triangle would flip, vanish, or be outside `limits`, where the outline of the
  /// star would change, or where it costs `bound` or more. Errors at posts are right to one
  /// rounding of a double. Cost: O(sides x posts).
  double CostOfCollapse(VertexId b, const TriangleLimits& limits, double bound);

  /// The posts under the star and its centre, handed out to the triangles that `b` takes over.
  /// Requires: CostOfCollapse(b, …) was not kNever; the surface has not yet collapsed.
  void HandOver(VertexId b, Coverage& coverage) const;

  /// Whether the surface as it stands is nowhere below the edge that would join two neighbours: then
  /// the edge hides nothing new. Exact. Requires: the edge lies within the star.
  [[nodiscard]] bool Covers(VertexId b, VertexId n) const;

  /// Appends the neighbours that an edge to `b` would be new for.
  void NewNeighbours(VertexId b, std::vector<VertexId>& others) const;

 private:
  // A triangle (b, w, x) of the fan that would take the star's place, relative to b.
  struct FanTriangle {
    std::int64_t wx, wy, wz;
    std::int64_t xx, xy, xz;
    std::int64_t twice_area;
    TriangleId triangle;
  };
  [[nodiscard]] bool BuildFan(VertexId b, const TriangleLimits& limits);
  // Whether the outline would run elsewhere: a centre on the outline may only move along it.
  [[nodiscard]] bool LeavesOutline(VertexId b) const;
  [[nodiscard]] static bool WithinShape(const Side& side, Point3i b, std::int64_t twice_area,
                                        const TriangleLimits& limits);
  // Error at a post under the fan, and the blade it lies under.
  struct Fit {
    double error;
    const FanTriangle* blade;
  };
  [[nodiscard]] Fit FitPost(Point3i post) const;

  struct Post {
    Point3i at;
    VertexId id;
  };

  const Terrain* terrain_;
  VertexId centre_ = -1;
  std::vector<Side> sides_;
  std::vector<VertexId> neighbours_;
  std::vector<Post> posts_;  // under the star, the centre among them
  std::int64_t twice_area_ = 0;
  double squares_ = 0;  // of the errors under the star as it stands

  std::vector<FanTriangle> fan_;
  Point3i hub_;  // where b is
};

}  // namespace farhorizon

#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/geometry/convex_polygon.h"
#include "core/geometry/segment.h"
#include "core/horizon/visibility/face_wedge.h"

namespace farhorizon {

/// The directions in which hulls of higher ground occlude all points of one edge, and virtual
/// occluders, which hand the same hulls on to the exact decision.
///
/// A direction of the half turn from the edge's own, lower end to higher, to its opposite is given
/// by its slope: minus the cotangent of its angle from the edge, which rises with the angle. The
/// slope of a post seen from the edge's point at t is linear in t and rises on the left of the
/// edge, falls on the right. So the two ends of the edge decide what is occluded from all of its
/// points (core/horizon/README.md, theorem 6). Exact; what it calls occluded is occluded, the
/// converse need not hold.
class EdgeOcclusion {
 public:
  /// Requires: low and high are neighbours in the grid. wedge: WedgeOf(low, high).
  EdgeOcclusion(Point2i low, Point2i high, const std::optional<FaceWedge>& wedge);

  /// Removes the directions that `hull` occludes; returns whether there are some. Add hulls that
  /// occlude most first: later ones then cost less. A hull that contains both ends is ignored:
  /// theorem 5 rules out such edges.
  /// Cost: the hull's corners, where a direction is left in which the hull can be seen.
  bool Add(const ConvexPolygon& hull);

  /// False only if no hull in the box [least, most] occludes a direction that is left.
  [[nodiscard]] bool MayOcclude(Point2i least, Point2i most) const;

  /// Whether all directions are occluded.
  [[nodiscard]] bool IsOccluded() const { return free_.empty(); }

  /// Appends virtual occluders at `height` for the hulls that could be seen in a direction that was
  /// left (virtual_occluders.h).
  void AppendVirtualOccluders(std::int32_t height, std::vector<Segment>& virtual_occluders) const;

 private:
  /// A slope as a fraction; denominator >= 0, infinite where it is 0. Both are integers: below 2^35
  /// for the wedge, below 2^18 for posts.
  struct Slope {
    double numerator;
    double denominator;
  };
  struct SlopeInterval {
    Slope from;
    Slope to;
  };
  /// Where a hull is from the edge, and the slopes of its silhouette's corners.
  enum class Position { kLeft, kRight, kAhead, kBehind, kInLine };
  struct SilhouetteSlopes {
    Position position;
    Slope right;
    Slope left;
  };
  struct PlanVector {
    double x;
    double y;
  };
  /// An open interval of slopes, and the directions of its ends.
  struct FreeInterval {
    SlopeInterval slopes;
    PlanVector first;
    PlanVector last;
  };

  static bool Less(const Slope& a, const Slope& b);
  [[nodiscard]] Slope SlopeOf(double x, double y) const;
  [[nodiscard]] SilhouetteSlopes SlopesFrom(Point2i viewpoint,
                                            const ConvexPolygon::Silhouette& silhouette) const;
  /// False where no direction was left in the interval.
  bool Occlude(const SlopeInterval& interval);
  /// Appends the open interval to `intervals` unless it is empty.
  void AppendFree(const SlopeInterval& slopes, std::vector<FreeInterval>& intervals) const;
  [[nodiscard]] PlanVector VectorOf(const Slope& slope) const;

  Point2i low_;
  Point2i high_;
  double dx_;
  double dy_;
  std::vector<FreeInterval> free_;  ///< rising, disjoint; all directions outside them are occluded
  std::vector<FreeInterval> next_free_;  ///< of Occlude, to spare allocations
  std::vector<ConvexPolygon::Silhouette> silhouettes_;
};

}  // namespace farhorizon

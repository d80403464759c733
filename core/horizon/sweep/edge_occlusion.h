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

  /// Removes the directions that `hull` occludes. Add hulls that occlude most first: later ones
  /// then cost less. A hull that contains both ends is ignored: theorem 5 has ruled out such edges.
  /// Cost: the hull's corners, where a direction is left in which the hull can be seen.
  void Add(const ConvexPolygon& hull);

  /// Whether all directions are occluded, by what is known so far.
  [[nodiscard]] bool IsOccluded() const { return !Less(free_.from, free_.to); }

  /// Applies what Add has put off; whether all directions are occluded. Requires: no hull is added
  /// after it.
  [[nodiscard]] bool Finish();

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

  static bool Less(const Slope& a, const Slope& b);
  [[nodiscard]] Slope SlopeOf(double x, double y) const;
  [[nodiscard]] SilhouetteSlopes SlopesFrom(Point2i viewpoint,
                                            const ConvexPolygon::Silhouette& silhouette) const;
  [[nodiscard]] bool MayOcclude(const ConvexPolygon& hull) const;
  void Occlude(const SlopeInterval& interval);
  void UpdateBounds();

  Point2i low_;
  Point2i high_;
  double dx_;
  double dy_;
  SlopeInterval free_;                ///< all directions outside it are occluded
  PlanVector first_free_;             ///< in the direction free_.from
  PlanVector last_free_;              ///< in the direction free_.to
  std::vector<SlopeInterval> inner_;  ///< occluded, with free directions on both sides
  std::vector<ConvexPolygon::Silhouette> silhouettes_;
};

}  // namespace farhorizon

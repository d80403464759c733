#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/geometry/convex_polygon.h"
#include "core/horizon/visibility/face_wedge.h"
#include "core/horizon/visibility/occluder_set.h"

namespace farhorizon {

/// What hulls of higher ground hide of one edge: the directions in which they do so from all of its points,
/// and the segments ("virtual occluders") that say the same to the exact decision, which looks from one point
/// at a time.
///
/// Directions are those of the half turn from the edge's own, lower end to higher, to its opposite, by
/// their slope: minus the cotangent of their angle from the edge, which rises with it. The slope of a
/// post as seen from the edge's point at t is linear in t, and rises on the left of the edge, falls
/// on the right; so the two ends of the edge tell what is hidden from everywhere. Exact.
class EdgeOcclusion {
 public:
  /// wedge: as WedgeOf(low, high).
  EdgeOcclusion(Point2i low, Point2i high, const std::optional<FaceWedge>& wedge);

  /// Takes away what a hull hides; sooner so for those that hide much.
  /// Cost: the hull's corners, if it shows in what is left.
  void Add(const ConvexPolygon& hull);

  /// Whether nothing is left to hide, as far as that is known by now.
  [[nodiscard]] bool IsFull() const { return !Less(rest_.from, rest_.to); }

  /// Whether all directions are hidden from every point. Requires: no more hulls to come.
  [[nodiscard]] bool IsComplete();

  /// Appends the virtual occluders at `level` of the hulls that showed in the rest, beside wider ones (virtual_occluders.h).
  void AppendVirtualOccluders(std::int32_t level, std::vector<Segment>& virtual_occluders) const;

 private:
  /// A slope as a fraction, denominator >= 0; infinite where that is 0. Whole numbers below 2^35, those
  /// of posts below 2^18: products of two of which one is a post's are exact.
  struct Slope {
    double numerator;
    double denominator;
  };
  struct Range {
    Slope from;
    Slope to;
  };
  /// A silhouette's corner in the edge's frame, and where the silhouette is from the edge.
  enum class Side { kLeft, kRight, kAhead, kBehind, kNowhere };
  struct View {
    Side side;
    Slope right;
    Slope left;
  };

  static bool Less(const Slope& a, const Slope& b);
  [[nodiscard]] Slope SlopeOf(double x, double y) const;
  [[nodiscard]] View ViewFrom(Point2i eye, const ConvexPolygon::Silhouette& silhouette) const;
  [[nodiscard]] bool ShowsInRest(const ConvexPolygon& hull) const;
  void Hide(const Range& range);
  void SetRays();

  Point2i low_;
  Point2i high_;
  double dx_;
  double dy_;
  Range rest_;  ///< nothing beyond is left
  struct Ray {
    double x;
    double y;
  };
  Ray first_ray_;  ///< the directions of its ends
  Ray last_ray_;
  std::vector<Range> inside_;  ///< hidden parts of the rest
  std::vector<ConvexPolygon::Silhouette> silhouettes_;
};

}  // namespace farhorizon

#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/geometry/point.h"

namespace farhorizon {

/// A convex polygon with corners at posts, counter-clockwise (from columns to rows), no three in
/// line; with one corner a point, with two a segment. Closed: its border is part of it. Exact.
class ConvexPolygon {
 public:
  ConvexPolygon() = default;
  explicit ConvexPolygon(Point2i point);
  /// The convex hull of `points` (reordered). Cost: O(n log n).
  static ConvexPolygon HullOf(std::vector<Point2i>& points);
  /// Requires: `corners` are those of a convex polygon, as corners() has them.
  static ConvexPolygon FromCorners(std::vector<Point2i> corners);

  /// Makes it the convex hull of itself and p. Requires: it has a corner; p is outside.
  /// Cost: O(n).
  void Extend(Point2i p);

  [[nodiscard]] const std::vector<Point2i>& corners() const { return corners_; }
  /// The least and the greatest corner of its bounding box.
  [[nodiscard]] Point2i least() const { return least_; }
  [[nodiscard]] Point2i most() const { return most_; }
  [[nodiscard]] bool Contains(Point2i p) const;
  /// Whether the two have a point in common. Cost: O(n m), constant where their boxes are disjoint.
  [[nodiscard]] bool Meets(const ConvexPolygon& other) const;

  /// The corners at which the tangents from a point touch: no part of the polygon is to the right
  /// of the ray from the point to `right`, or to the left of the ray to `left`.
  struct Silhouette {
    Point2i right;
    Point2i left;
  };
  /// Requires: two corners or more; `eye` is outside.
  [[nodiscard]] Silhouette SilhouetteFrom(Point2i eye) const;

  /// Calls visit(row, first column, last column) for each row that has posts in the polygon.
  void ForEachRow(const std::function<void(std::int32_t, std::int32_t, std::int32_t)>& visit) const;

 private:
  void FindBox();

  std::vector<Point2i> corners_;
  Point2i least_;
  Point2i most_;
};

}  // namespace farhorizon

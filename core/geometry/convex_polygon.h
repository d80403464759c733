#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/geometry/point.h"

namespace farhorizon {

/// A convex polygon with corners at posts, counter-clockwise, no three in line; a point or a segment
/// where it has one corner or two. Closed: its border is part of it. Exact.
class ConvexPolygon {
 public:
  ConvexPolygon() = default;
  explicit ConvexPolygon(Point2i point);
  /// The convex hull of `points` (reordered). Cost: O(n log n).
  static ConvexPolygon HullOf(std::vector<Point2i>& points);

  /// Makes it the convex hull of itself and p. Requires: a corner, p outside. Cost: O(n).
  void Extend(Point2i p);

  [[nodiscard]] const std::vector<Point2i>& corners() const { return corners_; }
  /// The corners of its box.
  [[nodiscard]] Point2i least() const { return least_; }
  [[nodiscard]] Point2i most() const { return most_; }
  [[nodiscard]] bool Contains(Point2i p) const;
  /// Whether the two have a point in common. Cost: O(n m), after a look at the boxes.
  [[nodiscard]] bool Meets(const ConvexPolygon& other) const;

  /// The corners between which the polygon is seen from `eye`: all of it is to the left of, or on, the ray
  /// to `right`, and to the right of the one to `left`. Requires: two corners, `eye` outside.
  struct Silhouette {
    Point2i right;
    Point2i left;
  };
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

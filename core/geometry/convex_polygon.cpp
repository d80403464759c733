// Convex polygons in 64-bit integers: all predicates are signs of cross products of differences of
// posts, below 2^33. Hulls are built by Andrew's monotone chain and extended by one point at a
// time, in time linear in the corners.
#include "core/geometry/convex_polygon.h"

#include <algorithm>
#include <utility>

#include "core/geometry/plan.h"
#include "core/geometry/row_span.h"

namespace farhorizon {

namespace {

bool OnSegment(Point2i a, Point2i b, Point2i p) {
  return Cross(a, b, p) == 0 && p.x >= std::min(a.x, b.x) && p.x <= std::max(a.x, b.x) &&
         p.y >= std::min(a.y, b.y) && p.y <= std::max(a.y, b.y);
}

int Sign(std::int64_t value) { return static_cast<int>(value > 0) - static_cast<int>(value < 0); }

// Whether two segments cross at an inner point of both. (Ends that touch are found by Contains.)
bool ProperlyCross(Point2i a, Point2i b, Point2i c, Point2i d) {
  return Sign(Cross(a, b, c)) * Sign(Cross(a, b, d)) < 0 &&
         Sign(Cross(c, d, a)) * Sign(Cross(c, d, b)) < 0;
}

// Whether a side of `a`, three corners or more, has all of `b` strictly on its outer side.
bool ASideSeparates(const std::vector<Point2i>& a, const std::vector<Point2i>& b) {
  Point2i from = a.back();
  for (const Point2i to : a) {
    if (std::all_of(b.begin(), b.end(), [&](Point2i p) { return Cross(from, to, p) < 0; })) {
      return true;
    }
    from = to;
  }
  return false;
}

}  // namespace

ConvexPolygon::ConvexPolygon(Point2i point) : corners_{point}, least_(point), most_(point) {}

ConvexPolygon ConvexPolygon::HullOf(std::vector<Point2i>& points) {
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  ConvexPolygon hull;
  if (points.size() < 3) {
    hull.corners_ = points;
    hull.FindBox();
    return hull;
  }
  std::vector<Point2i>& chain = hull.corners_;
  const auto extend = [&chain](Point2i p, std::size_t base) {
    while (chain.size() >= base + 2 && Cross(chain[chain.size() - 2], chain.back(), p) <= 0) {
      chain.pop_back();
    }
    chain.push_back(p);
  };
  for (const Point2i p : points) extend(p, 0);
  const std::size_t lower = chain.size() - 1;
  for (auto p = points.rbegin() + 1; p != points.rend(); ++p) extend(*p, lower);
  chain.pop_back();
  hull.FindBox();
  return hull;
}

ConvexPolygon ConvexPolygon::FromCorners(std::vector<Point2i> corners) {
  ConvexPolygon polygon;
  polygon.corners_ = std::move(corners);
  polygon.FindBox();
  return polygon;
}

void ConvexPolygon::Extend(Point2i p) {
  const std::size_t count = corners_.size();
  if (count < 3) {
    std::vector<Point2i> points = corners_;
    points.push_back(p);
    *this = HullOf(points);
    return;
  }
  // The sides that have p on their outer side, or in line, follow each other. They are replaced by
  // the two sides that meet at p.
  const auto has_outside = [&](std::size_t i) {
    return Cross(corners_[i % count], corners_[(i + 1) % count], p) <= 0;
  };
  std::size_t first = 0;
  if (has_outside(0)) {
    for (first = count; has_outside(first - 1);) --first;
  } else {
    while (!has_outside(first)) ++first;
  }
  std::size_t last = first;
  while (has_outside(last + 1)) ++last;
  std::rotate(corners_.begin(), corners_.begin() + static_cast<std::ptrdiff_t>(first % count),
              corners_.end());
  // Now these sides are those from corner 0 to corner last - first + 1.
  const std::ptrdiff_t past = static_cast<std::ptrdiff_t>(last - first) + 1;
  if (past == 1) {
    corners_.insert(corners_.begin() + 1, p);
  } else {
    corners_[1] = p;
    corners_.erase(corners_.begin() + 2, corners_.begin() + past);
  }
  least_ = {std::min(least_.x, p.x), std::min(least_.y, p.y)};
  most_ = {std::max(most_.x, p.x), std::max(most_.y, p.y)};
}

void ConvexPolygon::FindBox() {
  least_ = most_ = corners_.front();
  for (const Point2i p : corners_) {
    least_ = {std::min(least_.x, p.x), std::min(least_.y, p.y)};
    most_ = {std::max(most_.x, p.x), std::max(most_.y, p.y)};
  }
}

bool ConvexPolygon::Contains(Point2i p) const {
  if (p.x < least_.x || p.x > most_.x || p.y < least_.y || p.y > most_.y) return false;
  if (corners_.size() < 3) return OnSegment(corners_.front(), corners_.back(), p);
  // Binary search in the fan of triangles around the first corner for the one that can hold p.
  const Point2i o = corners_.front();
  if (Cross(o, corners_[1], p) < 0 || Cross(o, corners_.back(), p) > 0) return false;
  std::size_t low = 1;
  std::size_t high = corners_.size() - 1;
  while (high - low > 1) {
    const std::size_t middle = (low + high) / 2;
    (Cross(o, corners_[middle], p) >= 0 ? low : high) = middle;
  }
  return Cross(corners_[low], corners_[high], p) >= 0;
}

bool ConvexPolygon::Meets(const ConvexPolygon& other) const {
  if (other.most_.x < least_.x || other.least_.x > most_.x || other.most_.y < least_.y ||
      other.least_.y > most_.y) {
    return false;
  }
  // Disjoint polygons are separated by a side of one of them: each side of their Minkowski
  // difference is parallel to one of theirs.
  if (corners_.size() >= 3 && other.corners_.size() >= 3) {
    const bool fewer = corners_.size() < other.corners_.size();
    return !ASideSeparates(fewer ? corners_ : other.corners_, fewer ? other.corners_ : corners_) &&
           !ASideSeparates(fewer ? other.corners_ : corners_, fewer ? corners_ : other.corners_);
  }
  const auto contains_one_of = [](const ConvexPolygon& a, const ConvexPolygon& b) {
    return std::any_of(b.corners_.begin(), b.corners_.end(),
                       [&a](Point2i p) { return a.Contains(p); });
  };
  if (contains_one_of(*this, other) || contains_one_of(other, *this)) return true;
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const Point2i a = corners_[i];
    const Point2i b = corners_[(i + 1) % corners_.size()];
    for (std::size_t j = 0; j < other.corners_.size(); ++j) {
      if (ProperlyCross(a, b, other.corners_[j], other.corners_[(j + 1) % other.corners_.size()])) {
        return true;
      }
    }
  }
  return false;
}

ConvexPolygon::Silhouette ConvexPolygon::SilhouetteFrom(Point2i eye) const {
  Silhouette silhouette{corners_.front(), corners_.front()};
  for (const Point2i p : corners_) {
    if (Cross(eye, silhouette.right, p) < 0) silhouette.right = p;
    if (Cross(eye, silhouette.left, p) > 0) silhouette.left = p;
  }
  return silhouette;
}

void ConvexPolygon::ForEachRow(
    const std::function<void(std::int32_t, std::int32_t, std::int32_t)>& visit) const {
  std::vector<RowSpan> spans(static_cast<std::size_t>(most_.y - least_.y) + 1);
  const auto span_of = [&](std::int32_t row) -> RowSpan& {
    return spans[static_cast<std::size_t>(row - least_.y)];
  };
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    Point2i a = corners_[i];
    Point2i b = corners_[(i + 1) % corners_.size()];
    if (a.y > b.y) std::swap(a, b);
    span_of(a.y).IncludePost(a.x);
    span_of(b.y).IncludePost(b.x);
    for (std::int32_t row = a.y + 1; row < b.y; ++row) span_of(row).IncludeCrossing(a, b, row);
  }
  for (std::int32_t row = least_.y; row <= most_.y; ++row) {
    const RowSpan& span = span_of(row);
    if (!span.IsEmpty()) {
      visit(row, static_cast<std::int32_t>(span.first), static_cast<std::int32_t>(span.last));
    }
  }
}

}  // namespace farhorizon

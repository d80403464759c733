#include "core/horizon/sweep/edge_occlusion.h"

#include <algorithm>
#include <cmath>

#include "core/horizon/sweep/virtual_occluders.h"

namespace farhorizon {
namespace {

constexpr double kInfinite = 1;  // the numerator over a denominator of 0

}  // namespace

EdgeOcclusion::EdgeOcclusion(Point2i low, Point2i high, const std::optional<FaceWedge>& wedge)
    : low_(low),
      high_(high),
      dx_(high.x - low.x),
      dy_(high.y - low.y),
      rest_{{-kInfinite, 0}, {kInfinite, 0}} {
  if (wedge) {
    const Slope first =
        SlopeOf(static_cast<double>(wedge->first.x), static_cast<double>(wedge->first.y));
    const Slope last =
        SlopeOf(static_cast<double>(wedge->last.x), static_cast<double>(wedge->last.y));
    if (first.denominator > 0) rest_.from = first;
    if (last.denominator > 0) rest_.to = last;
  }
  SetRays();
}

bool EdgeOcclusion::Less(const Slope& a, const Slope& b) {
  if (a.denominator == 0 && b.denominator == 0) return a.numerator < b.numerator;
  return a.numerator * b.denominator < b.numerator * a.denominator;
}

EdgeOcclusion::Slope EdgeOcclusion::SlopeOf(double x, double y) const {
  const double along = dx_ * x + dy_ * y;
  const double across = dx_ * y - dy_ * x;
  return across >= 0 ? Slope{-along, across} : Slope{along, -across};
}

EdgeOcclusion::View EdgeOcclusion::ViewFrom(Point2i eye,
                                            const ConvexPolygon::Silhouette& silhouette) const {
  const auto side = [&](Point2i p) {
    const double across = dx_ * (p.y - eye.y) - dy_ * (p.x - eye.x);
    return static_cast<int>(across > 0) - static_cast<int>(across < 0);
  };
  const int right_side = side(silhouette.right);
  const int left_side = side(silhouette.left);
  View view{Side::kNowhere, SlopeOf(silhouette.right.x - eye.x, silhouette.right.y - eye.y),
            SlopeOf(silhouette.left.x - eye.x, silhouette.left.y - eye.y)};
  if (right_side == 0 && left_side == 0) return view;
  if (right_side == left_side) {
    view.side = right_side > 0 ? Side::kLeft : Side::kRight;
  } else if (left_side > right_side) {
    view.side = Side::kAhead;
    if (right_side == 0) view.right = {kInfinite, 0};
    if (left_side == 0) view.left = {-kInfinite, 0};
  } else {
    view.side = Side::kBehind;
    if (right_side == 0) view.right = {kInfinite, 0};
    if (left_side == 0) view.left = {-kInfinite, 0};
  }
  return view;
}

void EdgeOcclusion::SetRays() {
  const auto ray = [this](const Slope& slope) -> Ray {
    const double size = std::abs(slope.numerator) + slope.denominator;
    const double along = -slope.numerator / size;
    const double across = slope.denominator / size;
    return {along * dx_ - across * dy_, along * dy_ + across * dx_};
  };
  first_ray_ = ray(rest_.from);
  last_ray_ = ray(rest_.to);
}

// Hidden from everywhere: cuts off an end of the rest, or is kept for when it does.
void EdgeOcclusion::Hide(const Range& range) {
  if (!Less(range.from, range.to)) return;
  const bool cuts_first = !Less(rest_.from, range.from);
  const bool cuts_last = !Less(range.to, rest_.to);
  if (!cuts_first && !cuts_last) {
    inside_.push_back(range);
    return;
  }
  if (cuts_first && Less(rest_.from, range.to)) rest_.from = range.to;
  if (cuts_last && Less(range.from, rest_.to)) rest_.to = range.from;
  SetRays();
}

// Whether some of the hull's box may be in a direction of the rest from some point of the edge: what is
// on one side of both lines that bound it is not.
bool EdgeOcclusion::ShowsInRest(const ConvexPolygon& hull) const {
  constexpr double kMargin = 1e-6;
  const double x = 0.5 * (hull.least().x + hull.most().x - low_.x - high_.x);
  const double y = 0.5 * (hull.least().y + hull.most().y - low_.y - high_.y);
  const double half_width = 0.5 * (hull.most().x - hull.least().x + std::abs(dx_));
  const double half_height = 0.5 * (hull.most().y - hull.least().y + std::abs(dy_));
  const auto beside = [&](const Ray& ray) -> int {
    const double center = ray.x * y - ray.y * x;
    const double reach = std::abs(ray.x) * half_height + std::abs(ray.y) * half_width + kMargin;
    return static_cast<int>(center > reach) - static_cast<int>(center < -reach);
  };
  const int side = beside(first_ray_);
  return side == 0 || beside(last_ray_) != side;
}

void EdgeOcclusion::Add(const ConvexPolygon& hull) {
  if (hull.corners().size() < 2 || IsFull() || !ShowsInRest(hull)) return;
  const bool has_low = hull.Contains(low_);
  const bool has_high = hull.Contains(high_);
  if (has_low && has_high) return;  // hides all of it, which is for others to find
  // From the end that is outside a hull with the other end in it, the hull looks smallest.
  const Point2i from_low = has_low ? high_ : low_;
  const Point2i from_high = has_high ? low_ : high_;
  const ConvexPolygon::Silhouette silhouette = hull.SilhouetteFrom(from_low);
  silhouettes_.push_back(silhouette);
  const View low = ViewFrom(from_low, silhouette);
  const View high = ViewFrom(from_high, hull.SilhouetteFrom(from_high));
  if (low.side != high.side) return;
  switch (low.side) {
    case Side::kLeft:
      return Hide({high.right, low.left});
    case Side::kRight:
      return Hide({low.right, high.left});
    case Side::kAhead:
      Hide({{-kInfinite, 0}, low.left});
      return Hide({low.right, {kInfinite, 0}});
    case Side::kBehind:
      Hide({{-kInfinite, 0}, high.left});
      return Hide({high.right, {kInfinite, 0}});
    case Side::kNowhere:
      return;
  }
}

bool EdgeOcclusion::IsComplete() {
  std::sort(inside_.begin(), inside_.end(),
            [](const Range& a, const Range& b) { return Less(a.from, b.from); });
  const std::vector<Range> ranges = std::move(inside_);
  inside_.clear();
  for (const Range& range : ranges) Hide(range);
  return IsFull();
}

void EdgeOcclusion::AppendVirtualOccluders(std::int32_t level,
                                           std::vector<Segment>& virtual_occluders) const {
  SelectVirtualOccluders(low_, level, silhouettes_, virtual_occluders);
}

}  // namespace farhorizon

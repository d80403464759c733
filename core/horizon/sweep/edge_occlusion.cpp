// Slopes that hulls occlude from all points of an edge e, run from low to high
// (core/horizon/README.md, theorem 6):
//
//               L   hull on the left                 slopes of directions, counter-clockwise:
//              / \                                   -infinity along e, 0 across it to the left,
//        - - - - - - - - - - - - - - - - - -         +infinity against e
//     B        low ----e----> high         A
//        - - - - - - - - - - - - - - - - - -         A and B cross e's line
//                 \ /
//                  R   hull on the right
//
//     L  from its right corner seen from high     to its left corner seen from low
//     R  from its right corner seen from low      to its left corner seen from high
//     A  all but from its left corner             to its right corner, seen from low
//     B  all but from its left corner             to its right corner, seen from high
//
// The left and right corner of a silhouette are those at its counter-clockwise and clockwise end.
// What is left are a few intervals of slopes; hulls in other directions are skipped.
#include "core/horizon/sweep/edge_occlusion.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/horizon/sweep/virtual_occluders.h"

namespace farhorizon {

namespace {

constexpr double kInfinite = 1;  // the numerator over a denominator of 0

}  // namespace

EdgeOcclusion::EdgeOcclusion(Point2i low, Point2i high, const std::optional<FaceWedge>& wedge)
    : low_(low), high_(high), dx_(high.x - low.x), dy_(high.y - low.y) {
  SlopeInterval free{{-kInfinite, 0}, {kInfinite, 0}};
  if (wedge) {
    const Slope first =
        SlopeOf(static_cast<double>(wedge->first.x), static_cast<double>(wedge->first.y));
    const Slope last =
        SlopeOf(static_cast<double>(wedge->last.x), static_cast<double>(wedge->last.y));
    if (first.denominator > 0) free.from = first;
    if (last.denominator > 0) free.to = last;
  }
  AppendFree(free, free_);
}

// Exact in doubles for all slopes that are compared. With a post's slope: a product of integers
// below 2^35 and 2^18 is below 2^53. With an infinite slope: the products are 0 and a numerator.
// The two slopes of the wedge are compared with each other at the start only, where nothing is
// occluded yet. Each is of climb * to - rise * along with cross(along, to) = 1 for one face and -1
// for the other, so both have the denominator `climb`; their numerators, integers below 2^35,
// differ by more than 2^-35 of themselves if at all, and products with one factor keep their order
// through a rounding of 2^-53.
bool EdgeOcclusion::Less(const Slope& a, const Slope& b) {
  if (a.denominator == 0 && b.denominator == 0) return a.numerator < b.numerator;
  return a.numerator * b.denominator < b.numerator * a.denominator;
}

EdgeOcclusion::Slope EdgeOcclusion::SlopeOf(double x, double y) const {
  const double along = dx_ * x + dy_ * y;
  const double across = dx_ * y - dy_ * x;
  return across >= 0 ? Slope{-along, across} : Slope{along, -across};
}

EdgeOcclusion::SilhouetteSlopes EdgeOcclusion::SlopesFrom(
    Point2i viewpoint, const ConvexPolygon::Silhouette& silhouette) const {
  const auto side_of = [&](Point2i p) {
    const double across = dx_ * (p.y - viewpoint.y) - dy_ * (p.x - viewpoint.x);
    return static_cast<int>(across > 0) - static_cast<int>(across < 0);
  };
  const int right_side = side_of(silhouette.right);
  const int left_side = side_of(silhouette.left);
  SilhouetteSlopes slopes{
      Position::kInLine,
      SlopeOf(silhouette.right.x - viewpoint.x, silhouette.right.y - viewpoint.y),
      SlopeOf(silhouette.left.x - viewpoint.x, silhouette.left.y - viewpoint.y)};
  if (right_side == 0 && left_side == 0) return slopes;
  if (right_side == left_side) {
    slopes.position = right_side > 0 ? Position::kLeft : Position::kRight;
    return slopes;
  }
  slopes.position = left_side > right_side ? Position::kAhead : Position::kBehind;
  if (right_side == 0) slopes.right = {kInfinite, 0};
  if (left_side == 0) slopes.left = {-kInfinite, 0};
  return slopes;
}

EdgeOcclusion::PlanVector EdgeOcclusion::VectorOf(const Slope& slope) const {
  const double size = std::abs(slope.numerator) + slope.denominator;
  const double along = -slope.numerator / size;
  const double across = slope.denominator / size;
  return {along * dx_ - across * dy_, along * dy_ + across * dx_};
}

void EdgeOcclusion::AppendFree(const SlopeInterval& slopes,
                               std::vector<FreeInterval>& intervals) const {
  if (!Less(slopes.from, slopes.to)) return;
  intervals.push_back({slopes, VectorOf(slopes.from), VectorOf(slopes.to)});
}

// The interval is occluded from all points.
bool EdgeOcclusion::Occlude(const SlopeInterval& interval) {
  if (!Less(interval.from, interval.to)) return false;
  bool removed = false;
  next_free_.clear();
  for (const FreeInterval& free : free_) {
    const auto& [from, to] = free.slopes;
    if (!Less(from, interval.to) || !Less(interval.from, to)) {
      next_free_.push_back(free);
      continue;
    }
    removed = true;
    if (Less(from, interval.from)) AppendFree({from, interval.from}, next_free_);
    if (Less(interval.to, to)) AppendFree({interval.to, to}, next_free_);
  }
  free_.swap(next_free_);
  return removed;
}

// Whether, from some point of the edge, part of the box may lie in a free direction. It does not if
// the box, widened by the edge, is on one side of both lines that bound the free directions.
bool EdgeOcclusion::MayOcclude(Point2i least, Point2i most) const {
  // Any value is sound: hulls that are left out only leave more candidates. This one is above what
  // rounding does, less than 2^-30 with coordinates below 2^17 and vectors that are 2^-50 off, so
  // it leaves out no hull that matters; and it is far below the distance of two posts.
  constexpr double kMargin = 1e-6;
  const double x = 0.5 * (least.x + most.x - low_.x - high_.x);
  const double y = 0.5 * (least.y + most.y - low_.y - high_.y);
  const double half_width = 0.5 * (most.x - least.x + std::abs(dx_));
  const double half_height = 0.5 * (most.y - least.y + std::abs(dy_));
  const auto side_of = [&](const PlanVector& v) -> int {
    const double center = v.x * y - v.y * x;
    const double reach = std::abs(v.x) * half_height + std::abs(v.y) * half_width + kMargin;
    return static_cast<int>(center > reach) - static_cast<int>(center < -reach);
  };
  return std::any_of(free_.begin(), free_.end(), [&](const FreeInterval& free) {
    const int side = side_of(free.first);
    return side == 0 || side_of(free.last) != side;
  });
}

bool EdgeOcclusion::Add(const ConvexPolygon& hull) {
  if (hull.corners().size() < 2 || IsOccluded()) return false;
  const bool has_low = hull.Contains(low_);
  const bool has_high = hull.Contains(high_);
  if (has_low && has_high) return false;
  // A hull that contains one end occludes least as seen from the other end.
  const Point2i from_low = has_low ? high_ : low_;
  const Point2i from_high = has_high ? low_ : high_;
  const ConvexPolygon::Silhouette silhouette = hull.SilhouetteFrom(from_low);
  silhouettes_.push_back(silhouette);
  const SilhouetteSlopes low = SlopesFrom(from_low, silhouette);
  const SilhouetteSlopes high = SlopesFrom(from_high, hull.SilhouetteFrom(from_high));
  if (low.position != high.position) return false;
  switch (low.position) {
    case Position::kLeft:
      return Occlude({high.right, low.left});
    case Position::kRight:
      return Occlude({low.right, high.left});
    case Position::kAhead: {
      const bool first = Occlude({{-kInfinite, 0}, low.left});
      return Occlude({low.right, {kInfinite, 0}}) || first;
    }
    case Position::kBehind: {
      const bool first = Occlude({{-kInfinite, 0}, high.left});
      return Occlude({high.right, {kInfinite, 0}}) || first;
    }
    case Position::kInLine:
      return false;
  }
  return false;
}

void EdgeOcclusion::AppendVirtualOccluders(std::int32_t height,
                                           std::vector<Segment>& virtual_occluders) const {
  SelectVirtualOccluders(low_, height, silhouettes_, virtual_occluders);
}

}  // namespace farhorizon

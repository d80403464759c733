// Costs of half-edge collapses, measured at the posts. BuildFan makes the triangles that would
// replace the star and rejects those that would not cover it; FitPost finds the error at one post
// under them. Areas and crossings are exact integers; errors are doubles. Cost of a collapse tried:
// the star's triangles times the posts under it.
#include "core/simplify/star.h"

#include <algorithm>
#include <cmath>

#include "core/base/result.h"
#include "core/geometry/plan.h"

namespace farhorizon {

void Star::Gather(const Surface& surface, const PostsByTriangle& posts, VertexId v) {
  centre_ = v;
  triangles_.clear();
  neighbours_.clear();
  posts_.clear();
  twice_area_ = 0;
  squares_ = 0;
  const Point3i at = terrain_->Point(v);
  const auto add_neighbour = [this](VertexId n) {
    if (std::find(neighbours_.begin(), neighbours_.end(), n) == neighbours_.end()) {
      neighbours_.push_back(n);
    }
  };
  surface.ForEachTriangleOf(v, [&](TriangleId t, VertexId w, VertexId x) {
    const StarTriangle triangle{t, w, x, terrain_->Point(w), terrain_->Point(x)};
    triangles_.push_back(triangle);
    twice_area_ += TwiceArea(at, triangle.w_at, triangle.x_at);
    squares_ += posts.squares(t);
    add_neighbour(w);
    add_neighbour(x);
    posts.ForEachPostUnder(t, [this](VertexId p) { posts_.push_back({terrain_->Point(p), p}); });
  });
  posts_.push_back({at, v});
}

bool Star::WithinShape(const StarTriangle& triangle, Point3i b, std::int64_t twice_area,
                       const TriangleLimits& limits) {
  const std::int64_t to_w = SquaredLength(b, triangle.w_at);
  const std::int64_t to_x = SquaredLength(b, triangle.x_at);
  if (limits.longest_edge > 0) {
    const double most = limits.longest_edge * limits.longest_edge;
    if (static_cast<double>(std::max(to_w, to_x)) > most) return false;
  }
  const std::int64_t longest = std::max({to_w, to_x, SquaredLength(triangle.w_at, triangle.x_at)});
  // altitude = twice the area / longest side, compared in squares.
  if (static_cast<double>(twice_area) * static_cast<double>(twice_area) <
      limits.least_altitude * limits.least_altitude * static_cast<double>(longest)) {
    return false;
  }
  const Slope slope = SlopeOf(b, triangle.w_at, triangle.x_at);
  return slope.by_column <= limits.steepest.by_column && slope.by_row <= limits.steepest.by_row;
}

bool Star::ChangesOutline(VertexId b) const {
  // Around an inner vertex there are as many neighbours as triangles, around one on the outline one
  // more. The two neighbours on the outline are in one triangle of the star each, the others in
  // two.
  const bool closed = neighbours_.size() == triangles_.size();
  return !closed &&
         std::count_if(triangles_.begin(), triangles_.end(), [b](const StarTriangle& triangle) {
           return triangle.w == b || triangle.x == b;
         }) != 1;
}

bool Star::BuildFan(VertexId b, const TriangleLimits& limits) {
  fan_.clear();
  if (ChangesOutline(b)) return false;
  target_ = terrain_->Point(b);
  std::int64_t fan_area = 0;
  for (const StarTriangle& t : triangles_) {
    if (t.w == b || t.x == b) continue;
    const std::int64_t area = TwiceArea(target_, t.w_at, t.x_at);
    if (area <= 0 || !WithinShape(t, target_, area, limits)) return false;
    fan_area += area;
    fan_.push_back({t.w_at.x - target_.x, t.w_at.y - target_.y, std::int64_t{t.w_at.z} - target_.z,
                    t.x_at.x - target_.x, t.x_at.y - target_.y, std::int64_t{t.x_at.z} - target_.z,
                    area, t.id});
  }
  // Triangles that all turn counter-clockwise and have the star's area together cover it without
  // gap or overlap. That implies the link condition and, where the centre moves along the outline,
  // that the outline is straight there.
  return !fan_.empty() && fan_area == twice_area_;
}

Star::Fit Star::FitPost(Point3i post) const {
  const std::int64_t x = post.x - target_.x;
  const std::int64_t y = post.y - target_.y;
  for (const FanTriangle& t : fan_) {
    // The fan covers the star, so a post between the rays from b to w and to x lies in the
    // triangle.
    const std::int64_t of_x = t.wy * x - t.wx * y;
    if (of_x < 0) continue;
    const std::int64_t of_w = y * t.xx - x * t.xy;
    if (of_w < 0) continue;
    // of_w + of_x <= twice_area <= 2^30 and heights differ by less than 2^31: no overflow.
    const std::int64_t above =
        of_w * t.wz + of_x * t.xz - (std::int64_t{post.z} - target_.z) * t.twice_area;
    return {std::abs(static_cast<double>(above) / static_cast<double>(t.twice_area)), &t};
  }
  return {kNever, nullptr};
}

double Star::CostOfCollapse(VertexId b, const TriangleLimits& limits, double bound) {
  if (!BuildFan(b, limits)) return kNever;
  double squares = 0;
  for (std::size_t i = 0; i < posts_.size(); ++i) {
    const double error = FitPost(posts_[i].at).error;
    squares += error * error;
    if (error > limits.vertical_error || squares - squares_ >= bound) {
      // A post that rules out one neighbour often rules out the next: it is tried first there.
      std::swap(posts_[i], posts_.front());
      return kNever;
    }
  }
  return squares - squares_;
}

void Star::DistributePosts(VertexId b, PostsByTriangle& posts) const {
  for (const StarTriangle& t : triangles_) posts.Clear(t.id);
  Check(target_ == terrain_->Point(b), "posts are distributed to the fan that was tried last");
  for (const Post& post : posts_) {
    const Fit fit = FitPost(post.at);
    Check(fit.triangle != nullptr, "the fan covers every post of the star");
    // The analyzer does not know that Check throws.
    // NOLINTNEXTLINE(clang-analyzer-core.NullDereference)
    posts.Add(fit.triangle->id, post.id, fit.error);
  }
}

bool Star::IsBelowSurface(VertexId b, VertexId n) const {
  const Point3i v = terrain_->Point(centre_);
  Point3i p = terrain_->Point(b);
  Point3i q = terrain_->Point(n);
  const std::int64_t turn = TwiceArea(v, p, q);
  if (turn < 0) std::swap(p, q);
  if (turn == 0) {
    // The edge would pass through the centre: the heights there are compared, along the axis in
    // which the edge has an extent.
    const bool by_column = p.x != q.x;
    const std::int64_t whole = by_column ? q.x - p.x : q.y - p.y;
    const std::int64_t before = by_column ? v.x - p.x : v.y - p.y;
    const std::int64_t rise =
        (std::int64_t{q.z} - p.z) * before - (std::int64_t{v.z} - p.z) * whole;
    return whole > 0 ? rise <= 0 : rise >= 0;
  }
  // Edge and surface are both straight between the edges vw that the new edge crosses, so it is
  // enough to compare the heights there:
  //
  //               w
  //              /
  //     q ------+------ p      p, q counter-clockwise around v; w between them
  //            /
  //           v
  for (const VertexId neighbour : neighbours_) {
    if (neighbour == b || neighbour == n) continue;
    const Point3i w = terrain_->Point(neighbour);
    const bool crosses = TwiceArea(v, p, w) > 0 && TwiceArea(v, w, q) > 0;
    if (crosses && SideAtCrossing(v, w, p, q) < 0) return false;
  }
  return true;
}

void Star::NewNeighbours(VertexId b, std::vector<VertexId>& others) const {
  for (const VertexId n : neighbours_) {
    if (n == b) continue;
    const bool joined = std::any_of(
        triangles_.begin(), triangles_.end(),
        [&](const StarTriangle& t) { return (t.w == b && t.x == n) || (t.x == b && t.w == n); });
    if (!joined) others.push_back(n);
  }
}

}  // namespace farhorizon

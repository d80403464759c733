#include "core/simplify/star.h"

#include <algorithm>
#include <cmath>

#include "core/base/result.h"
#include "core/geometry/plan.h"

namespace farhorizon {

void Star::Gather(const Surface& surface, const Coverage& coverage, VertexId v) {
  centre_ = v;
  sides_.clear();
  neighbours_.clear();
  posts_.clear();
  twice_area_ = 0;
  squares_ = 0;
  const Point3i at = terrain_->Point(v);
  const auto meet = [this](VertexId n) {
    if (std::find(neighbours_.begin(), neighbours_.end(), n) == neighbours_.end()) {
      neighbours_.push_back(n);
    }
  };
  surface.ForEachTriangleOf(v, [&](TriangleId t, VertexId w, VertexId x) {
    const Side side{t, w, x, terrain_->Point(w), terrain_->Point(x)};
    sides_.push_back(side);
    twice_area_ += TwiceArea(at, side.w_at, side.x_at);
    squares_ += coverage.squares(t);
    meet(w);
    meet(x);
    coverage.ForEachPostUnder(t, [this](VertexId p) { posts_.push_back({terrain_->Point(p), p}); });
  });
  posts_.push_back({at, v});
}

bool Star::WithinShape(const Side& side, Point3i b, std::int64_t twice_area,
                       const TriangleLimits& limits) {
  const std::int64_t to_w = SquaredLength(b, side.w_at);
  const std::int64_t to_x = SquaredLength(b, side.x_at);
  if (limits.longest_edge > 0) {
    const double most = limits.longest_edge * limits.longest_edge;
    if (static_cast<double>(std::max(to_w, to_x)) > most) return false;
  }
  const std::int64_t longest = std::max({to_w, to_x, SquaredLength(side.w_at, side.x_at)});
  // altitude = twice the area / longest side, compared in squares.
  if (static_cast<double>(twice_area) * static_cast<double>(twice_area) <
      limits.least_altitude * limits.least_altitude * static_cast<double>(longest)) {
    return false;
  }
  const Slope slope = SlopeOf(b, side.w_at, side.x_at);
  return slope.by_column <= limits.steepest.by_column && slope.by_row <= limits.steepest.by_row;
}

bool Star::LeavesOutline(VertexId b) const {
  const bool closed = neighbours_.size() == sides_.size();
  // The two ends of an open fan are in one triangle of it each.
  return !closed && std::count_if(sides_.begin(), sides_.end(), [b](const Side& side) {
                      return side.w == b || side.x == b;
                    }) != 1;
}

bool Star::BuildFan(VertexId b, const TriangleLimits& limits) {
  fan_.clear();
  if (LeavesOutline(b)) return false;
  hub_ = terrain_->Point(b);
  std::int64_t twice_area = 0;
  for (const Side& side : sides_) {
    if (side.w == b || side.x == b) continue;
    const std::int64_t blade_area = TwiceArea(hub_, side.w_at, side.x_at);
    if (blade_area <= 0 || !WithinShape(side, hub_, blade_area, limits)) return false;
    twice_area += blade_area;
    fan_.push_back({side.w_at.x - hub_.x, side.w_at.y - hub_.y, std::int64_t{side.w_at.z} - hub_.z,
                    side.x_at.x - hub_.x, side.x_at.y - hub_.y, std::int64_t{side.x_at.z} - hub_.z,
                    blade_area, side.triangle});
  }
  // Blades that all turn the right way and fill the star's area exactly cover it without a gap: the
  // link condition and, where the centre moves along the outline, that it runs straight there.
  return !fan_.empty() && twice_area == twice_area_;
}

Star::Fit Star::FitPost(Point3i post) const {
  const std::int64_t x = post.x - hub_.x;
  const std::int64_t y = post.y - hub_.y;
  for (const FanTriangle& blade : fan_) {
    // The fan fills the star, so a post within a blade's wedge lies in the blade.
    const std::int64_t of_x = blade.wy * x - blade.wx * y;
    if (of_x < 0) continue;
    const std::int64_t of_w = y * blade.xx - x * blade.xy;
    if (of_w < 0) continue;
    // of_w + of_x <= twice_area <= 2^30 and heights differ by less than 2^31: no overflow.
    const std::int64_t above =
        of_w * blade.wz + of_x * blade.xz - (std::int64_t{post.z} - hub_.z) * blade.twice_area;
    return {std::abs(static_cast<double>(above) / static_cast<double>(blade.twice_area)), &blade};
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
      // What rules out one neighbour often rules out the next: look there first.
      std::swap(posts_[i], posts_.front());
      return kNever;
    }
  }
  return squares - squares_;
}

void Star::HandOver(VertexId b, Coverage& coverage) const {
  for (const Side& side : sides_) coverage.Clear(side.triangle);
  Check(hub_ == terrain_->Point(b), "posts are handed over to the neighbour tried last");
  for (const Post& post : posts_) {
    const Fit fit = FitPost(post.at);
    Check(fit.blade != nullptr, "the fan covers every post of the star");
    // NOLINTNEXTLINE(clang-analyzer-core.NullDereference): the analyzer does not know that Check throws
    coverage.Add(fit.blade->triangle, post.id, fit.error);
  }
}

bool Star::Covers(VertexId b, VertexId n) const {
  const Point3i v = terrain_->Point(centre_);
  Point3i p = terrain_->Point(b);
  Point3i q = terrain_->Point(n);
  std::int64_t turn = TwiceArea(v, p, q);
  if (turn < 0) std::swap(p, q);
  if (turn == 0) {
    // The edge would run through the centre: compare there, along the longer way.
    const bool by_column = p.x != q.x;
    const std::int64_t whole = by_column ? q.x - p.x : q.y - p.y;
    const std::int64_t part = by_column ? v.x - p.x : v.y - p.y;
    const std::int64_t rise = (std::int64_t{q.z} - p.z) * part - (std::int64_t{v.z} - p.z) * whole;
    return whole > 0 ? rise <= 0 : rise >= 0;
  }
  // Both are straight between the spokes that the edge crosses, so it is enough to compare there.
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
    const bool joined = std::any_of(sides_.begin(), sides_.end(), [&](const Side& side) {
      return (side.w == b && side.x == n) || (side.x == b && side.w == n);
    });
    if (!joined) others.push_back(n);
  }
}

}  // namespace farhorizon

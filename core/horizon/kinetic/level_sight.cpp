// A set of free lines that cross a level edge e is an open part of the strip (0, 1) x (directions).
// Unless there is no higher ground at all, it has a border inside the strip: lines that touch a hull,
// with free ones beside them, and nearly all of those touch one hull only, at one corner, inside a
// stretch of free tangents that has a width. So e is seen just where an inner tangent of such a
// stretch crosses the inside of e. The one exception: where two hulls come into contact at this very
// depth, lines through the contact that part them cannot be moved off both, and do not count.
#include "core/horizon/kinetic/level_sight.h"

#include <algorithm>
#include <utility>

namespace farhorizon::kinetic {

int LevelSight::Cross(const Vector& a, const Vector& b) {
  return CompareProducts(a.x, b.y, a.y, b.x);
}

int LevelSight::Dot(const Vector& a, const Vector& b) {
  return CompareProducts(a.x, b.x, -a.y, b.y);
}

// From p to q at depth s, or where they meet there, the direction in which q was before.
LevelSight::Vector LevelSight::Towards(PointId p, PointId q) const {
  const MovingPoint& a = scene_.point(p).path;
  const MovingPoint& b = scene_.point(q).path;
  const Vector was{Int128{b.x} * a.d - Int128{a.x} * b.d, Int128{b.y} * a.d - Int128{a.y} * b.d};
  const Vector speed{Int128{b.vx} * a.d - Int128{a.vx} * b.d,
                     Int128{b.vy} * a.d - Int128{a.vy} * b.d};
  const Vector now{was.x + speed.x * s_, was.y + speed.y * s_};
  if (now.x == 0 && now.y == 0) return {-speed.x, -speed.y};
  return now;
}

LevelSight::Vector LevelSight::DirectionOf(SideId side) const {
  const Vector v = Towards(scene_.Own(side), scene_.Other(side));
  return Scene::Ahead(side) ? v : Vector{-v.x, -v.y};
}

LevelSight::LevelSight(const Scene& scene, std::int64_t s) : scene_(scene), s_(s) {
  for (const ClusterId a : scene.apart()) {
    for (const ClusterId b : scene.apart()) {
      if (a < b && scene.MeetAt(a, b, s)) touching_.emplace_back(a, b);
    }
  }
  for (const ClusterId c : scene.apart()) {
    for (const PointId p : scene.cluster(c).corners) AddGaps(c, p);
  }
}

// A free tangent does not cut the other hull, so any of its corners off the line tells the side.
bool LevelSight::OnTheRight(const Gap& gap, ClusterId other) const {
  const Vector middle{gap.from.x + gap.to.x, gap.from.y + gap.to.y};
  for (const PointId q : scene_.cluster(other).corners) {
    const MovingPoint at = scene_.point(q).path.At(s_);
    const int side = Cross(middle, {Int128{at.x} * gap.corner.d - Int128{gap.corner.x} * at.d,
                                    Int128{at.y} * gap.corner.d - Int128{gap.corner.y} * at.d});
    if (side != 0) return side < 0;
  }
  return true;
}

void LevelSight::AddGaps(ClusterId c, PointId p) {
  const Scene::Point& corner = scene_.point(p);
  bool free = corner.depth == 0;
  SideId before = -1;
  const auto add = [&](SideId after) {
    if (!free || !scene_.HasWidth(p, before, after)) return;
    const Gap gap{corner.path.At(s_), before < 0 ? Towards(corner.prev, p) : DirectionOf(before),
                  after < 0 ? Towards(p, corner.next) : DirectionOf(after)};
    if (Cross(gap.from, gap.to) <= 0) return;
    for (const auto& [a, b] : touching_) {
      if ((a == c && OnTheRight(gap, b)) || (b == c && OnTheRight(gap, a))) return;
    }
    gaps_.push_back(gap);
  };
  for (const SideId side : corner.lit) {
    add(side);
    free = !free;
    before = side;
  }
  add(-1);
}

// Whether two open arcs of less than half a turn, each given counter-clockwise, have a direction in
// common.
bool LevelSight::Overlap(const Vector& a, const Vector& b, const Vector& from, const Vector& to) {
  const auto starts_in = [](const Vector& v, const Vector& begin, const Vector& end) {
    const int turn = Cross(begin, v);
    if (turn == 0) return Dot(begin, v) > 0;
    return turn > 0 && Cross(v, end) > 0;
  };
  return starts_in(a, from, to) || starts_in(from, a, b);
}

bool LevelSight::Sees(Point3i a, Point3i b) const {
  if (scene_.apart().empty()) return true;
  const auto from_corner = [](const MovingPoint& c, Point3i p) {
    return Vector{Int128{p.x} * c.d - c.x, Int128{p.y} * c.d - c.y};
  };
  return std::any_of(gaps_.begin(), gaps_.end(), [&](const Gap& gap) {
    Vector to_a = from_corner(gap.corner, a);
    Vector to_b = from_corner(gap.corner, b);
    const int turn = Cross(to_a, to_b);
    if (turn == 0) return Dot(to_a, to_b) < 0;
    if (turn < 0) std::swap(to_a, to_b);
    const auto opposite = [](const Vector& v) { return Vector{-v.x, -v.y}; };
    return Overlap(to_a, to_b, gap.from, gap.to) ||
           Overlap(opposite(to_a), opposite(to_b), gap.from, gap.to);
  });
}

}  // namespace farhorizon::kinetic

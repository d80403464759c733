// A set of visual lines that cross a horizontal edge e is an open subset of the strip (0, 1) x
// (directions). Unless there is no higher ground at all, it has a border inside the strip: lines
// that touch a hull, with visual ones beside them. Nearly all of those touch one hull only, at one
// corner, in a visual gap that has a width. So e is visible exactly if a line of such a gap crosses
// the inside of e. One exception: where two hulls come to touch at this very depth, lines through
// the contact that separate them cannot be moved off both, and do not count.
#include "core/horizon/kinetic/horizontal_edge_visibility.h"

#include <algorithm>

#include "core/geometry/direction.h"
#include "core/horizon/kinetic/hull_location.h"

namespace farhorizon::kinetic {

HorizontalEdgeVisibility::HorizontalEdgeVisibility(const Scene& scene, std::int64_t s)
    : scene_(scene), s_(s) {
  const KineticHulls& hulls = scene.hulls();
  for (const ClusterId a : hulls.clusters()) {
    for (const ClusterId b : hulls.clusters()) {
      if (a < b && HullsIntersectAt(hulls, a, b, s)) touching_.emplace_back(a, b);
    }
  }
  for (const ClusterId c : hulls.clusters()) {
    for (const PointId p : hulls.hull(c).corners) AddVisualGaps(c, p);
  }
}

void HorizontalEdgeVisibility::AddVisualGaps(ClusterId c, PointId p) {
  const KineticPoint& point = scene_.hulls().point(p);
  const std::vector<HalfTangentId>& active = scene_.order().corner(p).active_bitangents;
  for (std::size_t i = 0; i <= active.size(); ++i) {
    const HalfTangentId before = scene_.order().ActiveOrEdge(p, i - 1);
    const HalfTangentId after = scene_.order().ActiveOrEdge(p, i);
    if (!scene_.order().IsVisualGap(p, i) || !scene_.tangents().HasWidth(p, before, after))
      continue;
    AddVisualGap(
        c, {point.path.At(s_), before == kHullEdge ? Towards(point.prev, p) : DirectionOf(before),
            after == kHullEdge ? Towards(p, point.next) : DirectionOf(after)});
  }
}

// Not the gaps that have lost their width on the way to this depth, nor those whose lines separate
// the hull from one that it touches.
void HorizontalEdgeVisibility::AddVisualGap(ClusterId c, const VisualGap& gap) {
  if (CrossSign(gap.from, gap.to) <= 0) return;
  for (const auto& [a, b] : touching_) {
    if ((a == c && IsOnTheRight(gap, b)) || (b == c && IsOnTheRight(gap, a))) return;
  }
  gaps_.push_back(gap);
}

// Lines of a visual gap do not cut the other hull, so any corner of it that is off one tells its
// side.
bool HorizontalEdgeVisibility::IsOnTheRight(const VisualGap& gap, ClusterId other) const {
  const Vector middle{gap.from.x + gap.to.x, gap.from.y + gap.to.y};
  for (const PointId q : scene_.hulls().hull(other).corners) {
    const MovingPoint at = scene_.hulls().point(q).path.At(s_);
    const int side =
        CrossSign(middle, Vector{Int128{at.x} * gap.corner.d - Int128{gap.corner.x} * at.d,
                                 Int128{at.y} * gap.corner.d - Int128{gap.corner.y} * at.d});
    if (side != 0) return side < 0;
  }
  return true;
}

Vector HorizontalEdgeVisibility::DirectionOf(HalfTangentId half) const {
  const Vector v = Towards(scene_.tangents().Own(half), scene_.tangents().Other(half));
  return TangentTable::Ahead(half) ? v : -v;
}

// From p to q at this depth; where they meet there, the direction in which q was before.
Vector HorizontalEdgeVisibility::Towards(PointId p, PointId q) const {
  const MovingPoint& a = scene_.hulls().point(p).path;
  const MovingPoint& b = scene_.hulls().point(q).path;
  const Vector at_summit{Int128{b.x} * a.d - Int128{a.x} * b.d,
                         Int128{b.y} * a.d - Int128{a.y} * b.d};
  const Vector speed{Int128{b.vx} * a.d - Int128{a.vx} * b.d,
                     Int128{b.vy} * a.d - Int128{a.vy} * b.d};
  const Vector now{at_summit.x + speed.x * s_, at_summit.y + speed.y * s_};
  return now.IsZero() ? -speed : now;
}

namespace {

// Whether two open arcs of less than half a turn, each given counter-clockwise, have a direction in
// common.
bool ArcsOverlap(const Vector& a, const Vector& b, const Vector& from, const Vector& to) {
  const auto starts_in = [](const Vector& v, const Vector& begin, const Vector& end) {
    const int turn = CrossSign(begin, v);
    if (turn == 0) return DotSign(begin, v) > 0;
    return turn > 0 && CrossSign(v, end) > 0;
  };
  return starts_in(a, from, to) || starts_in(from, a, b);
}

}  // namespace

bool HorizontalEdgeVisibility::IsVisible(Point3i a, Point3i b) const {
  if (scene_.hulls().clusters().empty()) return true;
  const auto from_corner = [](const MovingPoint& c, Point3i p) {
    return Vector{Int128{p.x} * c.d - c.x, Int128{p.y} * c.d - c.y};
  };
  return std::any_of(gaps_.begin(), gaps_.end(), [&](const VisualGap& gap) {
    Vector to_a = from_corner(gap.corner, a);
    Vector to_b = from_corner(gap.corner, b);
    const int turn = CrossSign(to_a, to_b);
    if (turn == 0)
      return DotSign(to_a, to_b) < 0;  // the corner is inside the edge, or beside it in line
    if (turn < 0) std::swap(to_a, to_b);
    return ArcsOverlap(to_a, to_b, gap.from, gap.to) || ArcsOverlap(-to_a, -to_b, gap.from, gap.to);
  });
}

}  // namespace farhorizon::kinetic

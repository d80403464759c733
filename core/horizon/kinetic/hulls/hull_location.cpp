// Points in convex polygons by bisection of a fan, and two convex polygons by separating edges.
// Boxes in floating point rule out most pairs; all else is signs of orientations.
#include "core/horizon/kinetic/hulls/hull_location.h"

#include <algorithm>

namespace farhorizon::kinetic {

std::optional<std::array<PointId, 3>> TriangleAround(const KineticHulls& hulls,
                                                     std::span<const PointId> ring,
                                                     const MovingPoint& p) {
  const auto side = [&](PointId a, PointId b) {
    return OrientAfter(hulls.point(a).path, hulls.point(b).path, p, hulls.now());
  };
  if (ring.size() < 3 || side(ring[0], ring[1]) < 0 || side(ring[0], ring.back()) > 0) {
    return std::nullopt;
  }
  std::size_t low = 1;
  std::size_t high = ring.size() - 1;
  while (high - low > 1) {
    const std::size_t middle = (low + high) / 2;
    (side(ring[0], ring[middle]) >= 0 ? low : high) = middle;
  }
  if (side(ring[low], ring[high]) < 0) return std::nullopt;
  return std::array{ring[0], ring[low], ring[high]};
}

bool SurelyInsideAt(const KineticHulls& hulls, ClusterId c, std::int64_t x, std::int64_t y,
                    std::int64_t s) {
  const std::vector<PointId>& ring = hulls.corners(c);
  if (ring.size() < 3) return false;
  const MovingPoint p = MovingPoint::Standing(x, y);
  const auto side = [&](std::size_t i, std::size_t k) {
    return OrientAt(hulls.path(ring[i]), hulls.path(ring[k]), p, s);
  };
  if (side(0, 1) < 0 || side(0, ring.size() - 1) > 0) return false;
  std::size_t low = 1;
  std::size_t high = ring.size() - 1;
  while (high - low > 1) {
    const std::size_t middle = (low + high) / 2;
    (side(0, middle) >= 0 ? low : high) = middle;
  }
  // The corners may be in line or meet at s: only a triangle with the point inside is a proof.
  return side(0, low) > 0 && side(low, high) > 0 && side(high, 0) > 0;
}

namespace {

struct Box {
  double left = 1e30;
  double right = -1e30;
  double top = 1e30;
  double bottom = -1e30;
};

Box BoxOf(const KineticHulls& hulls, ClusterId c, double s, double margin) {
  Box around;
  for (const PointId p : hulls.hull(c).corners) {
    const MovingPoint& path = hulls.point(p).path;
    const auto d = static_cast<double>(path.d);
    const double x = (static_cast<double>(path.x) + static_cast<double>(path.vx) * s) / d;
    const double y = (static_cast<double>(path.y) + static_cast<double>(path.vy) * s) / d;
    around.left = std::min(around.left, x - margin);
    around.right = std::max(around.right, x + margin);
    around.top = std::min(around.top, y - margin);
    around.bottom = std::max(around.bottom, y + margin);
  }
  return around;
}

// Whether the boxes around the hulls have a point in common at some depth in [s, s + off]. Points
// move by one post per quantum at most. A coordinate is the difference of two terms below 2^32
// posts (an edge with a climb of one quantum, extended to the summit), made by four operations:
// floating point is off by less than 2^-17 posts.
bool BoxesIntersect(const KineticHulls& hulls, ClusterId a, ClusterId b, double s, double off) {
  const Box p = BoxOf(hulls, a, s, off + 1e-3);
  const Box q = BoxOf(hulls, b, s, off + 1e-3);
  return p.right >= q.left && q.right >= p.left && p.bottom >= q.top && q.bottom >= p.top;
}

// Whether some edge of `ring` has all corners of `other` strictly on its right: two convex polygons
// are disjoint exactly if one of them has such an edge.
template <typename Orient>
bool EdgeSeparates(const std::vector<PointId>& ring, const std::vector<PointId>& other,
                   const Orient& orient) {
  std::size_t first =
      0;  // the corner that was on the left of the last edge is often so of the next
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const PointId from = ring[i];
    const PointId to = ring[(i + 1) % ring.size()];
    std::size_t k = 0;
    while (k < other.size() && orient(from, to, other[(first + k) % other.size()]) < 0) ++k;
    if (k == other.size()) return true;
    first = (first + k) % other.size();
  }
  return false;
}

template <typename Orient>
bool RingsIntersect(const std::vector<PointId>& a, const std::vector<PointId>& b,
                    const Orient& orient) {
  return !EdgeSeparates(a, b, orient) && !EdgeSeparates(b, a, orient);
}

}  // namespace

bool HullsIntersect(const KineticHulls& hulls, ClusterId a, ClusterId b) {
  const SweepDepth& now = hulls.now();
  return BoxesIntersect(hulls, a, b, now.lo, now.hi - now.lo) &&
         RingsIntersect(hulls.hull(a).corners, hulls.hull(b).corners,
                        [&](PointId p, PointId q, PointId r) { return hulls.Orient(p, q, r); });
}

}  // namespace farhorizon::kinetic

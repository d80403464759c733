// Kinetic convex hulls: corners certified by strict turns, all other points by triangles of the hull.
// Simpler than the tree of Basch, Guibas and Hershberger (section 3.2.4): a failure costs O(h log h)
// for h corners instead of O(log^2), but what is inside costs one certificate a point, and only points
// on convex edges that are not already hidden for good are kept at all.
#include <algorithm>
#include <utility>

#include "core/base/result.h"
#include "core/horizon/kinetic/scene.h"

namespace farhorizon::kinetic {

void Scene::SettleHull(ClusterId c) {
  Cluster& hull = clusters_[Index(c)];
  for (const PointId p : hull.loose) {
    if (hull.dirty || !point(p).alive || Locate(c, point(p).path)) continue;
    hull.dirty = true;
  }
  std::vector<PointId> loose = std::move(hull.loose);
  hull.loose.clear();
  std::erase_if(loose, [this](PointId p) { return !point(p).alive; });
  for (const PointId p : loose) points_[Index(p)].cluster = c;
  unsettled_.insert(unsettled_.end(), loose.begin(), loose.end());
  if (!hull.dirty) return;
  hull.dirty = false;
  std::vector<PointId> candidates = loose;
  for (const PointId p : hull.corners) {
    if (point(p).alive) candidates.push_back(p);
  }
  std::vector<PointId> corners = HullOf(std::move(candidates));
  for (const PointId p : corners) {
    // A certificate that was taken out and is not pending has just failed.
    if (!point(p).corner && point(p).inside.stamp != 0) ++counts_.left_hulls;
  }
  SetCorners(c, std::move(corners));
}

// Strict corners, counter-clockwise, by Andrew's chains.
std::vector<PointId> Scene::HullOf(std::vector<PointId> candidates) const {
  std::sort(candidates.begin(), candidates.end());
  candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
  Check(candidates.size() >= 3, "the ground just below a post has a width");
  std::sort(candidates.begin(), candidates.end(), [this](PointId a, PointId b) {
    const int order = OrderAfter(point(a).path, point(b).path, now_);
    return order != 0 ? order < 0 : a < b;
  });
  std::vector<PointId> ring;
  const auto append = [&](PointId p, std::size_t least) {
    while (ring.size() > least && Orient(ring[ring.size() - 2], ring.back(), p) <= 0) {
      ring.pop_back();
    }
    ring.push_back(p);
  };
  for (const PointId p : candidates) append(p, 1);
  const std::size_t lower = ring.size();
  for (std::size_t i = candidates.size() - 1; i-- > 0;) append(candidates[i], lower);
  ring.pop_back();
  Check(ring.size() >= 3, "no ground is a line");
  return ring;
}

void Scene::SetCorners(ClusterId c, std::vector<PointId> corners) {
  Cluster& hull = clusters_[Index(c)];
  if (corners == hull.corners && !hull.fresh) return;
  const std::vector<PointId> old = std::exchange(hull.corners, std::move(corners));
  hull.recount = true;
  const std::size_t n = hull.corners.size();
  for (std::size_t i = 0; i < n; ++i) {
    const PointId p = hull.corners[i];
    const PointId prev = hull.corners[(i + n - 1) % n];
    const PointId next = hull.corners[(i + 1) % n];
    Point& corner = points_[Index(p)];
    corner.cluster = c;
    corner.index = static_cast<std::int32_t>(i);
    if (corner.corner && corner.prev == prev && corner.next == next && !hull.fresh) continue;
    corner.prev = prev;
    corner.next = next;
    Cancel(corner.inside);
    Shake(p);
    Schedule(Promise::kHull, p,
             TurnAfter(point(prev).path, corner.path, point(next).path, 1, now_,
                       FirstEnd(prev, p, next)));
  }
  for (const PointId p : old) points_[Index(p)].corner = false;
  for (const PointId p : hull.corners) points_[Index(p)].corner = true;
  for (const PointId p : old) {
    if (point(p).corner) continue;
    Cancel(points_[Index(p)].hull);
    Shake(p);
    if (point(p).alive) unsettled_.push_back(p);
  }
}

// The triangle of a fan from the first corner that the point is in just after now; nullopt outside.
std::optional<Scene::Triangle> Scene::Locate(ClusterId c, const MovingPoint& p) const {
  const std::vector<PointId>& ring = cluster(c).corners;
  const auto side = [&](PointId a, PointId b) {
    return OrientAfter(point(a).path, point(b).path, p, now_);
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
  return Triangle{{ring[0], ring[low], ring[high]}};
}

void Scene::KeepInside(PointId p) {
  Point& inside = points_[Index(p)];
  if (!inside.alive || inside.corner) return;
  const ClusterId c = Find(inside.cluster);
  inside.cluster = c;
  // Hulls only grow: what ends inside, or does not move, never comes out.
  const bool stays = inside.path.vx == 0 && inside.path.vy == 0;
  if (stays || Locate(c, inside.path.At(inside.end))) {
    inside.alive = false;
    Cancel(inside.inside);
    return;
  }
  const std::optional<Triangle> around = Locate(c, inside.path);
  Check(around.has_value(), "a point that is no corner is in its hull");
  const std::array<PointId, 3>& three = around->corners;
  const std::int64_t end = std::min(inside.end, FirstEnd(three[0], three[1], three[2]));
  Check(Compare(Moment::At(end), now_) > 0, "points are removed where they end");
  std::optional<Moment> first;
  if (end < inside.end) first = Moment::At(end);
  for (std::size_t i = 0; i < 3; ++i) {
    const MovingPoint& from = point(three[i]).path;
    const MovingPoint& to = point(three[(i + 1) % 3]).path;
    const std::optional<Moment> at = TurnAfter(from, to, inside.path, 1, now_, end);
    if (at && (!first || Compare(*at, *first) < 0)) first = at;
  }
  Schedule(Promise::kInside, p, first);
}

Scene::Box Scene::BoxOf(ClusterId c, double s, double margin) const {
  Box around;
  for (const PointId p : cluster(c).corners) {
    const MovingPoint& path = point(p).path;
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

// Two convex polygons are apart just where an edge of one has all corners of the other beyond it.
template <typename Turn>
bool Scene::AddObstacle(ClusterId a, ClusterId b, double s, double off, const Turn& turn) const {
  // Points move by a post a quantum at most; doubles are off by far less than a thousandth.
  const Box p = BoxOf(a, s, off + 1e-3);
  const Box q = BoxOf(b, s, off + 1e-3);
  if (p.right < q.left || q.right < p.left || p.bottom < q.top || q.bottom < p.top) return false;
  const auto parts = [&](const std::vector<PointId>& ring, const std::vector<PointId>& other) {
    std::size_t first = 0;  // the corner that was last on the wrong side, often so again
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const PointId from = ring[i];
      const PointId to = ring[(i + 1) % ring.size()];
      std::size_t k = 0;
      while (k < other.size() && turn(from, to, other[(first + k) % other.size()]) < 0) ++k;
      if (k == other.size()) return true;
      first = (first + k) % other.size();
    }
    return false;
  };
  return !parts(cluster(a).corners, cluster(b).corners) &&
         !parts(cluster(b).corners, cluster(a).corners);
}

bool Scene::AddObstacle(ClusterId a, ClusterId b) const {
  return AddObstacle(a, b, now_.lo, now_.hi - now_.lo,
                     [this](PointId p, PointId q, PointId r) { return Orient(p, q, r); });
}

bool Scene::MeetAt(ClusterId a, ClusterId b, std::int64_t s) const {
  return AddObstacle(a, b, static_cast<double>(s), 0, [&](PointId p, PointId q, PointId r) {
    return OrientAt(point(p).path, point(q).path, point(r).path, s);
  });
}

bool Scene::JoinFresh() {
  for (std::size_t i = 0; i < listed_.size(); ++i) {
    const ClusterId c = listed_[i];
    if (Find(c) != c || !cluster(c).fresh) continue;
    for (const ClusterId other : apart_) {
      if (other == c || !AddObstacle(c, other)) continue;
      Join(c, other);
      return true;
    }
  }
  return false;
}

// The two of an inner tangent that stands no more.
bool Scene::JoinAcross(SideId side) {
  if (Outer(side) || Stands(side / 2)) return false;
  const ClusterId a = Find(point(Own(side)).cluster);
  const ClusterId b = Find(point(Other(side)).cluster);
  if (!AddObstacle(a, b)) return false;
  Join(a, b);
  return true;
}

// What goes past an active tangent may go over the hull's edge with it, and all beside it, too.
void Scene::ShakePassed() {
  for (const Passed& passed : passed_) {
    for (const std::int32_t t : {passed.side / 2, passed.with / 2}) {
      if (tangent(t).touch[0] < 0 || Stands(t)) continue;
      for (const PointId p : tangent(t).touch) Shake(p);
    }
  }
}

// Joins clusters that touch just after now; true if there were any.
bool Scene::MergeWhatMeets() {
  if (JoinFresh()) return true;
  for (const auto& [side, p] : crossed_) {
    if (Own(side) >= 0 && JoinAcross(side)) return true;
  }
  ShakePassed();
  for (std::size_t i = 0; i < shaken_.size(); ++i) {
    for (const SideId side : point(shaken_[i]).sides) {
      if (JoinAcross(side)) return true;
    }
  }
  return false;
}

ClusterId Scene::Around(std::int64_t x, std::int64_t y) const {
  const MovingPoint p = MovingPoint::Standing(x, y);
  for (const ClusterId c : apart_) {
    const std::vector<PointId>& ring = cluster(c).corners;
    if (ring.empty()) continue;
    std::size_t i = 0;
    while (i < ring.size() &&
           OrientAt(point(ring[i]).path, point(ring[(i + 1) % ring.size()]).path, p, now_.s) >= 0) {
      ++i;
    }
    if (i == ring.size()) return c;
  }
  return -1;
}

}  // namespace farhorizon::kinetic

// The scene's invariants, looked at one by one from the predicates alone.
#include <algorithm>

#include "core/base/result.h"
#include "core/horizon/kinetic/scene.h"

namespace farhorizon::kinetic {

void Scene::CheckAll() const {
  for (const ClusterId c : apart_) {
    for (const ClusterId other : apart_) {
      if (other != c) CheckPair(c, other);
    }
    for (const PointId p : cluster(c).corners) {
      Check(Orient(point(p).prev, p, point(p).next) > 0, "corners are strictly convex");
      CheckCorner(p);
    }
  }
}

void Scene::CheckPair(ClusterId c, ClusterId other) const {
  Check(!AddObstacle(c, other), "hulls are apart");
  const std::int32_t first = FirstTangent(c, other);
  for (std::int32_t t = first; t < first + 4; ++t) {
    Check(Stands(t), "tangents stand");
    for (const SideId side : {2 * t, 2 * t + 1}) {
      const std::vector<SideId>& sides = point(Own(side)).sides;
      Check(std::count(sides.begin(), sides.end(), side) == 1, "corners know their tangents");
    }
  }
}

void Scene::CheckCorner(PointId p) const {
  const Point& corner = point(p);
  std::vector<SideId> sides = corner.sides;
  std::sort(sides.begin(), sides.end(), [this](SideId a, SideId b) { return Before(a, b); });
  int depth = corner.depth;
  std::size_t lit = 0;
  for (const SideId side : sides) {
    Check(Own(side) == p, "tangents are at their corners");
    const int after = depth + (Starts(side) ? 1 : -1);
    const bool active = depth == 0 || after == 0;
    Check(after >= 0, "a hull hides lines once at most");
    Check(Active(side) == active, "tangents beside visual lines are active, and no others");
    Check(LitOr(p, lit) == side || !active, "lit holds the active tangents in order");
    if (active) ++lit;
    depth = after;
  }
  Check(lit == corner.lit.size(), "lit holds no others");
  Check(depth == point(corner.next).depth, "depths go on from corner to corner");
  for (const SideId side : sides) {
    for (const std::size_t which : {0U, 1U}) CheckChain(side, which);
  }
}

// Towards the border of the gap, each certified with the next.
void Scene::CheckChain(SideId side, std::size_t which) const {
  const PointId p = Own(side);
  const auto with = [&](SideId s) { return tangent(s / 2).sides[s % 2 ? 1 : 0].with[which]; };
  if (Active(side)) {
    const auto& lit = point(p).lit;
    const auto at = static_cast<std::size_t>(std::find(lit.begin(), lit.end(), side) - lit.begin());
    const SideId near = LitOr(p, which == 0 ? at - 1 : at + 1);
    Check(with(side) == (which == 1 && near >= 0 ? side : near), "active tangents know the next");
    return;
  }
  const std::size_t gap = LitIndex(p, side);
  const SideId border = LitOr(p, which == 0 ? gap - 1 : gap);
  SideId s = side;
  while (s >= 0 && (s == side || !Active(s))) {
    const SideId next = with(s);
    Check(next != s && (next < 0 || Own(next) == p), "an inactive tangent hangs on another");
    Check(next < 0 || (which == 0 ? Before(next, s) : Before(s, next)),
          "what a tangent hangs on is nearer to the border");
    s = next;
  }
  Check(s == border, "an inactive tangent hangs on the border of its gap");
}

}  // namespace farhorizon::kinetic

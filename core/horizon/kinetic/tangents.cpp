// Bitangents of pairs of hulls, their activity and their certificates (sections 3.2.1 to 3.2.3).
#include <algorithm>
#include <utility>

#include "core/base/result.h"
#include "core/horizon/kinetic/scene.h"

namespace farhorizon::kinetic {

std::int32_t Scene::FirstTangent(ClusterId a, ClusterId b) const {
  const std::int32_t i = std::min(cluster(a).slot, cluster(b).slot);
  const std::int32_t j = std::max(cluster(a).slot, cluster(b).slot);
  return (j * (j - 1) / 2 + i) * 4;
}

// Which way the side's own corner must go for its hull to be left of the tangent: 0, -1 or 1. For any
// point outside a convex ring, following these steps ends at the right one of its two tangents.
int Scene::StepAt(SideId side) const {
  const PointId p = Own(side);
  const PointId q = Other(side);
  const int sense = Ahead(side) ? 1 : -1;
  if (sense * Orient(p, q, point(p).next) < 0) return 1;
  return sense * Orient(point(p).prev, p, q) < 0 ? -1 : 0;
}

bool Scene::Stands(std::int32_t t) const {
  const auto [p, q] = tangent(t).touch;
  return point(p).corner && point(q).corner && StepAt(2 * t) == 0 && StepAt(2 * t + 1) == 0;
}

// Moves the ends of a tangent to where it stands; `listed`: the corners' lists know it.
// Each round turns the line one way, so it ends; [Archambault03] section 3.2.2 walks alike.
void Scene::Walk(std::int32_t t, bool listed) {
  Tangent& walked = tangents_[Index(t)];
  const std::array<PointId, 2> from = walked.touch;
  for (std::size_t k = 0; k < 2; ++k) {
    const Point& old = point(from[k]);
    if (old.corner) continue;
    const ClusterId c = Find(old.cluster);
    walked.touch[k] = cluster(c).corners[0];
    for (const PointId near : {old.next, old.prev}) {
      if (near >= 0 && point(near).corner && Find(point(near).cluster) == c) walked.touch[k] = near;
    }
  }
  std::int64_t steps = 0;
  for (bool moved = true; moved;) {
    moved = false;
    for (std::size_t k = 0; k < 2; ++k) {
      PointId& p = walked.touch[k];
      while (const int step = StepAt(2 * t + static_cast<SideId>(k))) {
        p = step > 0 ? point(p).next : point(p).prev;
        moved = true;
        Check(++steps < 100'000'000, "the walk to a tangent ends");
      }
    }
  }
  for (std::size_t k = 0; k < 2; ++k) {
    const SideId side = 2 * t + static_cast<SideId>(k);
    if (listed && walked.touch[k] != from[k]) std::erase(points_[Index(from[k])].sides, side);
    if (!listed || walked.touch[k] != from[k]) {
      points_[Index(walked.touch[k])].sides.push_back(side);
    }
    if (listed) Shake(from[k]);
    Touch(walked.touch[k]);
    clusters_[Index(Find(point(walked.touch[k]).cluster))].recount = true;
  }
}

// Takes an inactive tangent over the edge of its hull that it crosses, all else being as it was: it
// changes no activity, and nobody's certificate is with it. False, and nothing done, where more than that
// happens at once.
bool Scene::CrossEdge(SideId s) {
  Tangent& crossing = tangents_[Index(s / 2)];
  PointId& p = crossing.touch[s % 2 ? 1 : 0];
  const PointId from = p;
  if (from < 0) return true;
  const PointId q = Other(s);
  const SideId opposite = s ^ 1;
  if (!point(from).corner || !point(q).corner || point(from).touched || point(q).touched ||
      Active(s) || Active(opposite)) {
    return false;
  }
  const int step = StepAt(s);
  if (step == 0) return false;
  p = step > 0 ? point(from).next : point(from).prev;
  std::vector<SideId>& sides = points_[Index(p)].sides;
  SideId near = -1;  // the first active tangent that it comes to
  for (const SideId other : sides) {
    if (Active(other) && (near < 0 || step < 0)) near = other;
  }
  const bool plain = !point(p).touched && Stands(s / 2) &&
                     (near < 0 || (step > 0 ? Before(s, near) : Before(near, s)));
  if (!plain) {
    p = from;
    return false;
  }
  std::erase(points_[Index(from)].sides, s);
  sides.insert(step > 0 ? sides.begin() : sides.end(), s);
  points_[Index(step > 0 ? p : from)].depth -= (Starts(s) ? 1 : -1) * step;
  Certify(s, 0, step > 0 ? -1 : near);
  Certify(s, 1, step > 0 ? near : -1);
  for (const std::size_t which : {0U, 1U}) Certify(opposite, which, SideOf(opposite).with[which]);
  return true;
}

void Scene::CrossEdges() {
  for (const SideId side : crossed_) {
    if (CrossEdge(side)) continue;
    const PointId p = Own(side);
    for (const PointId near : {p, point(p).prev, point(p).next, Other(side)}) {
      if (near >= 0) Shake(near);
    }
  }
  crossed_.clear();
}

void Scene::MakeTangents(ClusterId a, ClusterId b) {
  const std::int32_t first = FirstTangent(a, b);
  if (tangent(first).touch[0] >= 0) return;
  if (cluster(a).slot > cluster(b).slot) std::swap(a, b);
  for (std::int32_t t = first; t < first + 4; ++t) {
    tangents_[Index(t)].touch = {cluster(a).corners[0], cluster(b).corners[0]};
    Walk(t, false);
  }
}

void Scene::DropTangents(ClusterId a, ClusterId b) {
  const std::int32_t first = FirstTangent(a, b);
  for (std::int32_t t = first; t < first + 4; ++t) {
    Tangent& dropped = tangents_[Index(t)];
    if (dropped.touch[0] < 0) return;
    for (std::size_t k = 0; k < 2; ++k) {
      std::erase(points_[Index(dropped.touch[k])].sides, 2 * t + static_cast<SideId>(k));
      Touch(dropped.touch[k]);
      clusters_[Index(Find(point(dropped.touch[k]).cluster))].recount = true;
      Tangent::Side& side = dropped.sides[k];
      for (Certificate& certificate : side.certificates) Cancel(certificate);
      side.keys = {};
      side.active = false;
    }
    dropped.touch = {-1, -1};
  }
}

void Scene::UpdateTangents() {
  CrossEdges();
  for (const ClusterId c : listed_) {
    if (Find(c) != c || !cluster(c).fresh) continue;
    for (const ClusterId other : apart_) {
      if (other != c) MakeTangents(c, other);
    }
  }
  for (std::size_t i = 0; i < shaken_.size(); ++i) {
    const std::vector<SideId> sides = point(shaken_[i]).sides;
    for (const SideId side : sides) {
      if (!Stands(side / 2)) Walk(side / 2, true);
    }
  }
  for (const PointId p : shaken_) points_[Index(p)].shaken = false;
  shaken_.clear();
  doubtful_.clear();
  for (const PointId p : touched_) SortSides(p);
  std::vector<ClusterId> around;
  for (const PointId p : touched_) {
    if (!point(p).corner) continue;
    const ClusterId c = Find(point(p).cluster);
    if (std::exchange(clusters_[Index(c)].recount, false)) around.push_back(c);
  }
  const std::size_t sorted = touched_.size();
  for (const ClusterId c : around) Recount(c);
  for (std::size_t i = sorted; i < touched_.size(); ++i) SortSides(touched_[i]);
  for (const PointId p : touched_) {
    if (point(p).corner) Refresh(p);
    points_[Index(p)].touched = false;
  }
  touched_.clear();
}

// The order of two tangents at one corner just after the moment.
bool Scene::Before(SideId a, SideId b) const {
  const int sense = Ahead(a) == Ahead(b) ? 1 : -1;
  const int turn = sense * Orient(Own(a), Other(a), Other(b));
  if (turn != 0) return turn > 0;
  return Starts(a) != Starts(b) ? Starts(a) : a < b;
}

void Scene::SortSides(PointId p) {
  std::vector<SideId>& sides = points_[Index(p)].sides;
  for (std::size_t i = 1; i < sides.size(); ++i) {
    for (std::size_t k = i; k > 0 && Before(sides[k], sides[k - 1]); --k) {
      std::swap(sides[k], sides[k - 1]);
    }
  }
}

// How many hulls hide the lines at each corner's first edge. Another hull's tangents alternate, so the
// first one met tells whether it hides the lines where the round begins.
void Scene::Recount(ClusterId c) {
  ++seen_round_;
  int depth = 0;
  for (const PointId p : cluster(c).corners) {
    for (const SideId side : point(p).sides) {
      const std::int32_t slot = cluster(Find(point(Other(side)).cluster)).slot;
      int& seen = seen_slot_[Index(slot)];
      if (seen != seen_round_ && !Starts(side)) ++depth;
      seen = seen_round_;
    }
  }
  for (const PointId p : cluster(c).corners) {
    Point& corner = points_[Index(p)];
    if (corner.depth != depth) Touch(p);
    corner.depth = depth;
    for (const SideId side : corner.sides) depth += Starts(side) ? 1 : -1;
  }
}

bool Scene::HasWidth(PointId p, SideId before, SideId after) const {
  if (before < 0 && after < 0) return true;
  const auto sense = [](SideId side) { return Ahead(side) ? 1 : -1; };
  if (before < 0) return sense(after) * Orient(point(p).prev, p, Other(after)) > 0;
  if (after < 0) return sense(before) * Orient(p, Other(before), point(p).next) > 0;
  return sense(before) * sense(after) * Orient(p, Other(before), Other(after)) > 0;
}

// Activities, certificates and what is seen at one corner, whose tangents are in order.
void Scene::Refresh(PointId p) {
  Point& corner = points_[Index(p)];
  const std::vector<SideId>& sides = corner.sides;
  int depth = corner.depth;
  for (std::size_t i = 0; i <= sides.size(); ++i) {
    if (depth == 0 && !corner.seen) {
      corner.seen = HasWidth(p, i == 0 ? -1 : sides[i - 1], i == sides.size() ? -1 : sides[i]);
    }
    Check(depth >= 0, "a hull hides lines once at most");
    if (i == sides.size()) break;
    const int after = depth + (Starts(sides[i]) ? 1 : -1);
    SideOf(sides[i]).active = depth == 0 || after == 0;
    depth = after;
  }
  SideId before = -1;
  for (const SideId side : sides) {
    Certify(side, 0, before);
    if (Active(side)) before = side;
  }
  SideId after = -1;
  for (std::size_t i = sides.size(); i-- > 0;) {
    const SideId side = sides[i];
    if (Active(side) && after >= 0) {
      Certify(side, 1, side);  // the one after has the certificate with this one
    } else {
      Certify(side, 1, after);
    }
    if (Active(side)) after = side;
  }
}

// The certificate of a tangent with what is next before (0) or after it (1): another tangent, the edge
// of the hull (-1), or none (itself).
void Scene::Certify(SideId s, std::size_t which, SideId with) {
  Tangent::Side& side = SideOf(s);
  side.with[which] = with;
  const SideId id = 2 * s + static_cast<SideId>(which);
  Tangent::Key key;
  if (with != s) {
    const PointId p = Own(s);
    const PointId q = Other(s);
    const bool scene = with >= 0;
    key.sign = (Ahead(s) ? 1 : -1) * (!scene || Ahead(with) ? 1 : -1);
    if (which == 0) {
      key.points = scene ? std::array{p, Other(with), q} : std::array{point(p).prev, p, q};
    } else {
      key.points = {p, q, scene ? Other(with) : point(p).next};
    }
  }
  if (key == side.keys[which]) return;
  side.keys[which] = key;
  if (key.sign == 0) {
    Cancel(side.certificates[which]);
    return;
  }
  const auto [a, b, c] = key.points;
  Schedule(Promise::kTangent, id,
           TurnAfter(point(a).path, point(b).path, point(c).path, key.sign, now_, FirstEnd(a, b, c)));
}

void Scene::CheckAll() const {
  for (const ClusterId c : apart_) {
    for (const PointId p : cluster(c).corners) {
      Check(Orient(point(p).prev, p, point(p).next) > 0, "corners are strictly convex");
    }
    for (const ClusterId other : apart_) {
      if (other >= c) continue;
      Check(!Meet(c, other), "hulls are apart");
      const std::int32_t first = FirstTangent(c, other);
      for (std::int32_t t = first; t < first + 4; ++t) Check(Stands(t), "tangents stand");
    }
  }
}

}  // namespace farhorizon::kinetic

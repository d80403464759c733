// Bitangents of pairs of hulls: where they stand, and what they hide (sections 3.2.1 to 3.2.3).
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
// point outside a convex ring, following these steps ends at the right one of its two tangents. One that
// stays in line with an edge of the hull hides it: a start stands before it, an end after it. So what a
// hull hides contains what its parts did, whatever is in line.
int Scene::StepAt(SideId side) const {
  const PointId p = Own(side);
  const PointId q = Other(side);
  const int sense = Ahead(side) ? 1 : -1;
  const int next = sense * Orient(p, q, point(p).next);
  if (next < 0) return 1;
  const int prev = sense * Orient(point(p).prev, p, q);
  if (prev < 0) return -1;
  return Starts(side) ? (prev == 0 ? -1 : 0) : (next == 0 ? 1 : 0);
}

bool Scene::Stands(std::int32_t t) const {
  const auto [p, q] = tangent(t).touch;
  return point(p).corner && point(q).corner && StepAt(2 * t) == 0 && StepAt(2 * t + 1) == 0;
}

// Moves the ends of a tangent to where it stands. Each round turns the line one way, so it ends;
// [Archambault03] section 3.2.2 walks alike.
void Scene::WalkFreely(std::int32_t t) {
  Tangent& walked = tangents_[Index(t)];
  for (PointId& p : walked.touch) {
    const Point& old = point(p);
    if (old.corner) continue;
    const ClusterId c = Find(old.cluster);
    p = cluster(c).corners[0];
    for (const PointId near : {old.next, old.prev}) {
      if (near >= 0 && point(near).corner && Find(point(near).cluster) == c) p = near;
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
}

void Scene::Walk(std::int32_t t) {
  const std::array<PointId, 2> from = tangent(t).touch;
  WalkFreely(t);
  for (std::size_t k = 0; k < 2; ++k) {
    const PointId to = tangent(t).touch[k];
    const SideId side = 2 * t + static_cast<SideId>(k);
    if (to == from[k]) {
      if (!point(to).touched) Renew(side);
      continue;
    }
    Shake(from[k]);
    TakeOff(from[k], side);
    points_[Index(to)].sides.push_back(side);
    Touch(to);
    clusters_[Index(Find(point(to).cluster))].recount = true;
  }
}

// Takes an inactive tangent over the edge of its hull that it crosses, all else being as it was: it
// changes no activity. False, and nothing done, where more than that happens at once.
bool Scene::CrossEdge(SideId s) {
  PointId& p = tangents_[Index(s / 2)].touch[s % 2 ? 1 : 0];
  const PointId from = p;
  const PointId q = Other(s);
  const SideId opposite = s ^ 1;
  if (!point(from).corner || !point(q).corner || point(from).touched || point(q).touched ||
      Active(s) || Active(opposite)) {
    return false;
  }
  const int step = StepAt(s);
  if (step == 0) return false;
  p = step > 0 ? point(from).next : point(from).prev;
  const std::vector<SideId>& lit = point(p).lit;
  const SideId near = lit.empty() ? -1 : step > 0 ? lit.front() : lit.back();
  const PointId edge = step > 0 ? p : from;
  const int depth = point(edge).depth - (Starts(s) ? step : -step);
  const bool plain = depth > 0 && !point(p).touched && Stands(s / 2) &&
                     (near < 0 || (step > 0 ? Before(s, near) : Before(near, s)));
  if (!plain) {
    p = from;
    return false;
  }
  TakeOff(from, s);
  points_[Index(p)].sides.push_back(s);
  points_[Index(edge)].depth = depth;
  Certify(s, 0, step > 0 ? -1 : near);
  Certify(s, 1, step > 0 ? near : -1);
  Renew(opposite);
  return true;
}

void Scene::CrossEdges() {
  for (const auto& [side, p] : crossed_) {
    if (Own(side) < 0) {
      TouchAround(p);
    } else if (!CrossEdge(side)) {
      for (const PointId near :
           {Own(side), point(Own(side)).prev, point(Own(side)).next, Other(side)}) {
        if (near >= 0) Shake(near);
      }
    }
  }
  crossed_.clear();
}

// The sides at which the lines begin and end that the hull touched there hides from the k-th of a pair:
// those that meet it ahead, and behind.
std::array<Scene::Arc, 2> Scene::ArcsOf(std::int32_t first, SideId k) {
  std::array<Arc, 2> arcs;
  for (SideId side = 2 * first + k; side < 2 * (first + 4); side += 2) {
    Arc& arc = arcs[Ahead(side) ? 0 : 1];
    (Starts(side) ? arc.start : arc.end) = side;
  }
  return arcs;
}

void Scene::HideArc(const Arc& arc) {
  const PointId last = Own(arc.end);
  PointId p = Own(arc.start);
  if (cluster(Find(point(p).cluster)).recount) {
    // A corner on the way may be as deep as before and hidden for all that: by this hull throughout, where
    // one that is part of it now ended.
    Touch(last);
    for (Touch(p); p != last; p = point(p).next) {
      if (!point(p).lit.empty()) Touch(p);
    }
    return;
  }
  for (bool begins = true;; begins = false, p = point(p).next) {
    Shade(p, begins ? arc.start : -1, p == last ? arc.end : -1);
    if (!begins) ++points_[Index(p)].depth;
    if (p == last) return;
  }
}

// What was hidden by hulls that are no more is hidden by those that they are part of now. So depths go
// down only when those have their tangents: at no moment is it free.
void Scene::ReleaseArcs() {
  for (const auto& [from, last] : released_) {
    if (cluster(Find(point(from).cluster)).recount) continue;
    for (PointId p = from; p != last;) {
      p = point(p).next;
      --points_[Index(p)].depth;
    }
  }
  released_.clear();
}

void Scene::MakeTangents(ClusterId a, ClusterId b) {
  const std::int32_t first = FirstTangent(a, b);
  if (tangent(first).touch[0] >= 0) return;
  if (cluster(a).slot > cluster(b).slot) std::swap(a, b);
  for (std::int32_t t = first; t < first + 4; ++t) {
    Tangent& made = tangents_[Index(t)];
    made.touch = {cluster(a).corners[0], cluster(b).corners[0]};
    for (Tangent::Side& side : made.sides) side.hanging = {};
    WalkFreely(t);
    for (const SideId side : {2 * t, 2 * t + 1}) points_[Index(Own(side))].sides.push_back(side);
  }
  for (const SideId k : {0, 1}) {
    for (const Arc& arc : ArcsOf(first, k)) HideArc(arc);
  }
}

// Certificates do not tell of what comes in line just where a point ends.
void Scene::TouchWhatIsInLine(SideId s) {
  const PointId p = Own(s);
  if (!now_.whole || std::min(point(p).end, point(Other(s)).end) > now_.s) return;
  const auto in_line = [this](PointId a, PointId b, PointId c) {
    return OrientAt(point(a).path, point(b).path, point(c).path, now_.s) == 0;
  };
  const auto fails = [&](SideId side, std::size_t which) {
    const Tangent::Key& key = SideOf(side).keys[which];
    return key.sign != 0 && in_line(key.points[0], key.points[1], key.points[2]);
  };
  const std::vector<SideId>& sides = point(p).sides;
  const Tangent::Side& side = SideOf(s);
  const bool hangs = side.hanging[0] != 0 || side.hanging[1] != 0;
  const auto tied = [&](SideId other) {
    return (SideOf(other).with[0] == s && fails(other, 0)) ||
           (SideOf(other).with[1] == s && fails(other, 1));
  };
  if (!fails(s, 0) && !fails(s, 1) && !(hangs && std::any_of(sides.begin(), sides.end(), tied))) {
    return;
  }
  TouchAround(p);
  for (const SideId other : sides) {
    const PointId q = Other(other);  // -1: dropped before, with its hull
    if (q >= 0 && in_line(p, Other(s), q)) Touch(q);
  }
}

void Scene::DropTangents(ClusterId a, ClusterId b) {
  const std::int32_t first = FirstTangent(a, b);
  if (tangent(first).touch[0] < 0) return;
  for (const SideId k : {0, 1}) {
    for (const Arc& arc : ArcsOf(first, k)) released_.emplace_back(Own(arc.start), Own(arc.end));
  }
  for (SideId side = 2 * first; side < 2 * (first + 4); ++side) {
    TouchWhatIsInLine(side);
    TakeOff(Own(side), side);
  }
  for (std::int32_t t = first; t < first + 4; ++t) {
    Tangent& dropped = tangents_[Index(t)];
    dropped.touch = {-1, -1};
    for (Tangent::Side& side : dropped.sides) {
      side.active = false;
      side.with = {-1, -1};
    }
  }
}

// How many hulls hide the lines at each corner's first edge.
void Scene::Recount(ClusterId c) {
  const std::vector<PointId>& ring = cluster(c).corners;
  std::vector<int>& turns = turns_;  // by how much it is more than at the corner before
  turns.assign(ring.size() + 1, 0);
  for (const ClusterId other : apart_) {
    if (other == c) continue;
    const std::int32_t first = FirstTangent(c, other);
    for (const Arc& arc : ArcsOf(first, cluster(c).slot < cluster(other).slot ? 0 : 1)) {
      const std::int32_t from = point(Own(arc.start)).index;
      const std::int32_t to = point(Own(arc.end)).index;
      ++turns[Index(from + 1)];
      --turns[Index(to + 1)];
      if (from > to) ++turns[0];
    }
  }
  int depth = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    depth += turns[i];
    Point& corner = points_[Index(ring[i])];
    if (corner.depth != depth && (corner.depth == 0 || depth == 0 || !corner.lit.empty())) {
      Touch(ring[i]);
    }
    corner.depth = depth;
  }
}

void Scene::WalkShaken() {
  for (std::size_t i = 0; i < shaken_.size(); ++i) {
    const std::vector<SideId> sides = point(shaken_[i]).sides;
    for (const SideId side : sides) {
      if (!point(Own(side)).corner || StepAt(side) != 0) Walk(side / 2);
    }
  }
  for (const PointId p : shaken_) points_[Index(p)].shaken = false;
  shaken_.clear();
}

// What hangs on others has no certificate with the hull's edge, and may have gone over it with them. And
// where points end, tangents may have changed places here that parted at a third corner.
void Scene::LookAtTouched(PointId p) {
  if (!point(p).corner) return;
  for (const SideId side : point(p).sides) {
    const Tangent::Side& hanging = SideOf(side);
    if ((hanging.with[0] >= 0 || hanging.with[1] >= 0) && StepAt(side) != 0) {
      Shake(p);
      break;
    }
  }
  if (!now_.whole) return;
  SortSides(p);
  for (std::size_t i = 1; i < aimed_.size(); ++i) {
    if (TurnOf(aimed_[i - 1].first, aimed_[i].first) != 0) continue;
    const PointId a = Other(aimed_[i - 1].second);
    const PointId b = Other(aimed_[i].second);
    if (OrientAt(point(p).path, point(a).path, point(b).path, now_.s) != 0 ||
        Orient(p, a, b) == 0) {
      continue;
    }
    Touch(a);
    Touch(b);
  }
}

// Until no look touches another.
void Scene::LookAtAllTouched() {
  std::size_t looked_at = 0;
  for (bool done = false; !done; done = looked_at == touched_.size()) {
    for (; looked_at < touched_.size(); ++looked_at) LookAtTouched(touched_[looked_at]);
    WalkShaken();
    for (std::size_t i = 0; i < touched_.size(); ++i) {
      if (!point(touched_[i]).corner) continue;
      const ClusterId c = Find(point(touched_[i]).cluster);
      if (std::exchange(clusters_[Index(c)].recount, false)) Recount(c);
    }
  }
}

namespace {

bool SameThree(std::array<PointId, 3> a, std::array<PointId, 3> b) {
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  return a == b;
}

}  // namespace

void Scene::UpdateTangents() {
  const bool alone = listed_.empty() && shaken_.empty() && touched_.empty() && crossed_.empty() &&
                     std::all_of(passed_.begin(), passed_.end(), [&](const Passed& passed) {
                       return SameThree(passed.points, passed_.front().points);
                     });
  if (alone) {
    PassTangents();
  } else {
    for (const Passed& passed : passed_) {
      for (const PointId p : passed.points) Touch(p);
    }
    CrossEdges();
  }
  passed_.clear();
  WalkShaken();
  for (const ClusterId c : listed_) {
    if (Find(c) != c || !cluster(c).fresh) continue;
    for (const ClusterId other : apart_) {
      if (other != c) MakeTangents(c, other);
    }
  }
  ReleaseArcs();
  LookAtAllTouched();
  for (const PointId p : touched_) {
    points_[Index(p)].touched = false;
    if (point(p).corner) Rebuild(p);
  }
  touched_.clear();
}

}  // namespace farhorizon::kinetic

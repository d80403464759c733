// The conductor of algorithm 3.1 of [Archambault03]: what happens at an event, in the numbered
// steps of bitangent_scene.h. All state is in the parts. What a step leaves for later ones (marks,
// crossings, collinear pairs, dropped arcs, changed hulls) is used up when RestoreInvariants()
// returns. Cost of an event: O(h) for each changed hull of h corners, O(m (h + log n)) for each new
// one among m hulls and n certificates, and O(k log n) for each stale corner with k half tangents.
#include "core/horizon/kinetic/bitangents/bitangent_scene.h"

#include <algorithm>
#include <utility>

#include "core/base/result.h"
#include "core/horizon/kinetic/hulls/hull_location.h"

namespace farhorizon::kinetic {

PointId BitangentScene::Add(ClusterId cluster, const MovingPoint& path, std::int64_t end,
                            std::int32_t tag) {
  order_.AddPoint();
  return hulls_.Add(cluster, path, end, tag);
}

ClusterId BitangentScene::NewCluster() {
  const ClusterId c = hulls_.NewCluster();
  tangents_.AddCluster(c);
  certificates_.Resize();
  order_.Resize();
  return c;
}

// Both become new: all of their tangents are dropped, and those of the one that is left are made
// anew.
ClusterId BitangentScene::Join(ClusterId a, ClusterId b) {
  a = Find(a);
  b = Find(b);
  if (a == b) return a;
  if (hulls_.hull(a).corners.size() < hulls_.hull(b).corners.size()) std::swap(a, b);
  ++counts_.merges;
  hulls_.MarkNew(a);
  hulls_.MarkNew(b);
  for (const ClusterId other : hulls_.clusters()) {
    if (other != a) DropTangents(a, other);
    if (other != b && other != a) DropTangents(b, other);
  }
  for (const ClusterId c : {a, b}) {
    for (const PointId p : hulls_.hull(c).corners) order_.RemoveAll(p);
  }
  hulls_.Join(a, b);
  tangents_.RemoveCluster(b);
  return a;
}

void BitangentScene::Advance(const SweepDepth& now) {
  hulls_.AdvanceTo(now);
  while (const std::optional<Event> event = queue_.PopAt(now)) {
    // All others here are tangents: covers are a NeighbourScene's.
    if (hulls_.Fail(*event, counts_)) continue;
    FailTangent(event->id / 2, static_cast<std::size_t>(event->id % 2));
  }
}

void BitangentScene::FailTangent(HalfTangentId half, std::size_t which) {
  const HalfTangentId partner = certificates_.partner(half, which);
  const std::array<PointId, 3> points = certificates_.points(half, which);
  const bool active = order_.IsActive(half);
  certificates_.Fail(half, which);
  if (partner != kHullEdge) {
    const int count = (active ? 1 : 0) + (order_.IsActive(partner) ? 1 : 0);
    // Two inactive ones are no event of the thesis: one deferred to the other.
    if (count > 0) ++counts_.tangent_failures[count == 2 ? 0 : 1];
    collinear_.Add({half, which, partner, points});
    return;
  }
  ++counts_.tangent_failures[active ? 2 : 3];
  if (active) {
    for (const PointId p : points) marks_.MarkDisplaced(p);
  } else {
    motion_.AddCrossing(half);
  }
}

void BitangentScene::RestoreInvariants() {
  // 1. Hulls and 2. collisions, until no two hulls intersect.
  do {
    UpdateHulls();
  } while (JoinIntersecting());
  counts_.looks += static_cast<std::int64_t>(hulls_.clusters().size());
  counts_.clusters_max =
      std::max(counts_.clusters_max, static_cast<std::int64_t>(hulls_.clusters().size()));
  // 3. Collinear corners.
  const bool nothing_else = hulls_.changed().empty() && marks_.stale().empty() &&
                            motion_.crossings().empty() && collinear_.AreOne();
  if (nothing_else) {
    collinear_.Exchange();
  } else {
    collinear_.MarkStale();
    motion_.CrossEdges();
  }
  // 4. Displaced corners.
  motion_.WalkDisplaced();
  // 5. Pairs.
  MakeTangentsOfNewHulls();
  depths_.ReleaseDropped();
  // 6. Propagation.
  PropagateMarks();
  // 7. Rebuilding.
  RebuildStale();
  // 8. Interior points.
  hulls_.LocateInteriorPoints();
}

void BitangentScene::UpdateHulls() {
  for (const ClusterId c : hulls_.TakeOutdated()) {
    if (Find(c) == c) counts_.left_interior += hulls_.UpdateHull(c);
  }
}

// Joins two hulls that intersect just after now; false if there are none. Before, the inner
// tangents proved that they are disjoint. So only those pairs are asked of which one hull is new,
// or of which an inner tangent may no longer support both: one that has failed, or one at a
// displaced corner.
bool BitangentScene::JoinIntersecting() {
  if (JoinNewHull()) return true;
  for (const TangentMotion::Crossing& crossing : motion_.crossings()) {
    if (tangents_.Own(crossing.half) >= 0 && JoinAcross(crossing.half)) return true;
  }
  collinear_.MarkDisplaced();
  for (const PointId p : marks_.displaced()) {
    for (const HalfTangentId half : order_.corner(p).half_tangents) {
      if (JoinAcross(half)) return true;
    }
  }
  return false;
}

bool BitangentScene::JoinNewHull() {
  for (const ClusterId c : hulls_.changed()) {
    if (Find(c) != c || !hulls_.hull(c).is_new) continue;
    for (const ClusterId other : hulls_.clusters()) {
      if (other == c || !HullsIntersect(hulls_, c, other)) continue;
      Join(c, other);
      return true;
    }
  }
  return false;
}

bool BitangentScene::JoinAcross(HalfTangentId half) {
  const TangentId t = TangentOf(half);
  if (TangentTable::Outer(t) || tangents_.Supports(t)) return false;
  const ClusterId a = hulls_.ClusterOf(tangents_.Own(half));
  const ClusterId b = hulls_.ClusterOf(tangents_.Other(half));
  if (!HullsIntersect(hulls_, a, b)) return false;
  Join(a, b);
  return true;
}

void BitangentScene::MakeTangentsOfNewHulls() {
  for (const ClusterId c : hulls_.changed()) {
    if (Find(c) != c || !hulls_.hull(c).is_new) continue;
    for (const ClusterId other : hulls_.clusters()) {
      if (other != c) MakeTangents(c, other);
    }
  }
}

void BitangentScene::MakeTangents(ClusterId a, ClusterId b) {
  const TangentId first = tangents_.First(a, b);
  if (tangents_.Exists(first)) return;
  tangents_.Make(a, b);
  for (HalfTangentId half = 2 * first; half < 2 * (first + 4); ++half) {
    certificates_.ClearDeferred(half);
    order_.Insert(half);
  }
  for (const std::int32_t end : {0, 1}) {
    for (const Arc& arc : TangentTable::ArcsAtEnd(first, end)) depths_.Occlude(arc);
  }
}

void BitangentScene::DropTangents(ClusterId a, ClusterId b) {
  const TangentId first = tangents_.First(a, b);
  if (!tangents_.Exists(first)) return;
  for (const std::int32_t end : {0, 1}) {
    for (const Arc& arc : TangentTable::ArcsAtEnd(first, end)) depths_.Drop(arc);
  }
  const HalfTangentId halves_end = 2 * (first + 4);
  for (HalfTangentId half = 2 * first; half < halves_end; ++half) {
    motion_.MarkCollinearEnd(half);
    order_.Remove(tangents_.Own(half), half);
  }
  tangents_.Drop(first);
  for (HalfTangentId half = 2 * first; half < halves_end; ++half) {
    order_.Deactivate(half);
    certificates_.ClearPartners(half);
  }
}

void BitangentScene::PropagateMarks() {
  std::size_t done = 0;  // of the stale corners; there are more and more
  do {
    for (; done < marks_.stale().size(); ++done) motion_.MarkBesideStale(marks_.stale()[done]);
    motion_.WalkDisplaced();
    for (std::size_t i = 0; i < marks_.stale().size(); ++i) {
      const PointId p = marks_.stale()[i];
      if (!hulls_.point(p).corner) continue;
      const ClusterId c = hulls_.ClusterOf(p);
      if (marks_.TakeRecount(c)) depths_.Recount(c);
    }
  } while (done != marks_.stale().size());
}

void BitangentScene::RebuildStale() {
  for (const PointId p : marks_.stale()) {
    if (hulls_.point(p).corner) order_.Rebuild(p);
  }
  marks_.ClearStale();
}

void BitangentScene::CheckAll() const {
  hulls_.CheckPoints();
  for (const ClusterId c : hulls_.clusters()) {
    for (const ClusterId other : hulls_.clusters()) {
      if (other == c) continue;
      Check(!HullsIntersect(hulls_, c, other), "hulls are disjoint");
      tangents_.CheckTangents(c, other);
      const HalfTangentId first = 2 * tangents_.First(c, other);
      for (HalfTangentId half = first; half < first + 8; ++half) order_.CheckListed(half);
    }
    hulls_.CheckHull(c);
    for (const PointId p : hulls_.hull(c).corners) order_.CheckCorner(p);
  }
}

}  // namespace farhorizon::kinetic

// Tangents by walking from corner to corner [Archambault03, section 3.2.2], with the signs of
// orientations just after now.
#include "core/horizon/kinetic/neighbours/separating_tangents.h"

#include <algorithm>
#include <array>
#include <optional>

#include "core/base/result.h"
#include "core/horizon/kinetic/hulls/hull_location.h"

namespace farhorizon::kinetic {

bool SeparatingTangents::Exists(ClusterId a, ClusterId b) const {
  const std::vector<TangentId>& few = of_cluster_[Index(a)].size() < of_cluster_[Index(b)].size()
                                          ? of_cluster_[Index(a)]
                                          : of_cluster_[Index(b)];
  return std::any_of(few.begin(), few.end(), [&](TangentId t) {
    const SeparatingTangent& of = tangent(t);
    return (of.a == a && of.b == b) || (of.a == b && of.b == a);
  });
}

void SeparatingTangents::Make(ClusterId a, ClusterId b) {
  TangentId t = static_cast<TangentId>(tangents_.size());
  if (free_.empty()) {
    tangents_.emplace_back();
  } else {
    t = free_.back();
    free_.pop_back();
  }
  tangents_[Index(t)] = {a, b, hulls_.corners(a)[0], hulls_.corners(b)[0]};
  of_cluster_[Index(a)].push_back(t);
  of_cluster_[Index(b)].push_back(t);
  Check(Walk(tangents_[Index(t)]), "disjoint hulls have a separating tangent");
  Certify(t);
}

void SeparatingTangents::DropAllOf(ClusterId c) {
  for (const TangentId t : of_cluster_[Index(c)]) {
    SeparatingTangent& tangent = tangents_[Index(t)];
    std::erase(of_cluster_[Index(tangent.a == c ? tangent.b : tangent.a)], t);
    queue_.Cancel(CertificateKind::kTangent, t);
    tangent = {};
    free_.push_back(t);
  }
  of_cluster_[Index(c)].clear();
}

// The step towards the corner at which the line from `other` supports own's hull, which is on its
// left where it is directed towards `other`: 1 to the next corner, -1 to the previous one, 0 none.
// Of an edge in the line, the end nearer to `other` is taken.
int SeparatingTangents::StepAt(PointId own, PointId other) const {
  const KineticPoint& at = hulls_.point(own);
  const int next = hulls_.Orient(own, other, at.next);
  if (next < 0) return 1;
  if (hulls_.Orient(own, other, at.prev) < 0) return -1;
  return next == 0 ? 1 : 0;
}

// Each round turns the line one way, so the walk ends where the hulls are disjoint. Where it takes
// more than some steps, they are asked whether they are; any number is sound.
bool SeparatingTangents::Walk(SeparatingTangent& tangent) const {
  constexpr std::int64_t kStepsBeforeDoubt = 16;
  constexpr std::int64_t kMostSteps = 100'000'000;  // above all corners of two hulls
  std::int64_t steps = 0;
  for (bool moved = true; moved;) {
    moved = false;
    for (const bool at_p : {true, false}) {
      PointId& own = at_p ? tangent.p : tangent.q;
      const PointId other = at_p ? tangent.q : tangent.p;
      while (const int step = StepAt(own, other)) {
        own = step > 0 ? hulls_.point(own).next : hulls_.point(own).prev;
        moved = true;
        ++steps;
        if (steps == kStepsBeforeDoubt && HullsIntersect(hulls_, tangent.a, tangent.b)) {
          return false;
        }
        Check(steps < kMostSteps, "the walk to a tangent ends");
      }
    }
  }
  return true;
}

bool SeparatingTangents::Restore(TangentId t) {
  SeparatingTangent moved = tangent(t);
  for (const bool at_p : {true, false}) {
    PointId& own = at_p ? moved.p : moved.q;
    const ClusterId c = at_p ? moved.a : moved.b;
    const auto is_corner = [&](PointId p) {
      return p >= 0 && hulls_.point(p).corner && hulls_.ClusterOf(p) == c;
    };
    if (is_corner(own)) continue;
    const KineticPoint& old = hulls_.point(own);
    own = is_corner(old.next) ? old.next : is_corner(old.prev) ? old.prev : hulls_.corners(c)[0];
  }
  if (!Walk(moved)) return false;
  tangents_[Index(t)] = moved;
  Certify(t);
  return true;
}

void SeparatingTangents::Certify(TangentId t) {
  const SeparatingTangent& tangent = tangents_[Index(t)];
  const KineticPoint& p = hulls_.point(tangent.p);
  const KineticPoint& q = hulls_.point(tangent.q);
  std::int64_t end = std::min(p.end, q.end);
  std::optional<SweepDepth> first;
  for (const PointId corner : {p.prev, p.next, q.prev, q.next}) {
    const bool of_p = corner == p.prev || corner == p.next;
    const KineticPoint& beside = hulls_.point(corner);
    const std::optional<SweepDepth> at = TurnFailureAfter(
        {p.path, q.path, beside.path}, of_p ? 1 : -1, hulls_.now(), std::min(end, beside.end));
    if (at && (!first || Compare(*at, *first) < 0)) first = at;
  }
  queue_.Schedule(CertificateKind::kTangent, t, first);
}

void SeparatingTangents::CheckTangent(TangentId t) const {
  const SeparatingTangent& of = tangent(t);
  Check(hulls_.point(of.p).corner && hulls_.point(of.q).corner, "tangents touch corners");
  Check(hulls_.ClusterOf(of.p) == of.a && hulls_.ClusterOf(of.q) == of.b,
        "tangents touch their hulls");
  Check(StepAt(of.p, of.q) == 0 && StepAt(of.q, of.p) == 0, "tangents separate their hulls");
}

}  // namespace farhorizon::kinetic

// A half tangent moves in one of two ways: across one edge of its hull, where nothing else happens,
// so that all else stays as it is (CrossEdge); or by walking as far as it has to (Walk), and then
// the order at the corners that it leaves and comes to is found anew.
// Cost: O(log n) for an edge; for a walk, the corners on the way and the half tangents at its ends.
#include "core/horizon/kinetic/bitangents/tangent_motion.h"

#include <algorithm>

namespace farhorizon::kinetic {

void TangentMotion::CrossEdges() {
  for (const Crossing& crossing : crossings_) {
    const PointId p = tangents_.Own(crossing.half);
    if (p < 0) {  // dropped since
      MarkWithNeighbours(crossing.corner);
    } else if (!CrossEdge(crossing.half)) {
      const KineticPoint& corner = hulls_.point(p);
      for (const PointId near : {p, corner.prev, corner.next, tangents_.Other(crossing.half)}) {
        if (near >= 0) marks_.MarkDisplaced(near);
      }
    }
  }
  crossings_.clear();
}

// Moves an inactive half tangent across the edge of its hull that it crosses, all else being as it
// was. No activity changes then, and of the depths only the one of that edge: the crossing takes
// the edge's line into the other hull's arc or out of it. False, and nothing is done, where more
// than that happens at once.
//
//     step 1: p to its next corner         the edge is the first edge of the new corner
//     step -1: p to its previous corner    the edge is the first edge of the old corner
bool TangentMotion::CrossEdge(HalfTangentId half) {
  const PointId from = tangents_.Own(half);
  const PointId q = tangents_.Other(half);
  if (!hulls_.point(from).corner || !hulls_.point(q).corner || marks_.IsStale(from) ||
      marks_.IsStale(q) || order_.IsActive(half) || order_.IsActive(Opposite(half))) {
    return false;
  }
  const int step = tangents_.StepAt(half);
  if (step == 0) return false;
  const PointId to = step > 0 ? hulls_.point(from).next : hulls_.point(from).prev;
  tangents_.MoveTo(half, to);
  const std::vector<HalfTangentId>& active = order_.corner(to).active_bitangents;
  const HalfTangentId near = active.empty() ? kHullEdge : step > 0 ? active.front() : active.back();
  const PointId edge = step > 0 ? to : from;
  const int change = TangentTable::Starts(half) ? -step : step;
  const bool plain = order_.corner(edge).depth + change > 0 && !marks_.IsStale(to) &&
                     tangents_.Supports(TangentOf(half)) &&
                     (near == kHullEdge ||
                      (step > 0 ? tangents_.Before(half, near) : tangents_.Before(near, half)));
  if (!plain) {
    tangents_.MoveTo(half, from);
    return false;
  }
  order_.Remove(from, half);
  order_.Insert(half);
  order_.AddToDepth(edge, change);
  certificates_.Certify(half, 0, step > 0 ? kHullEdge : near);
  certificates_.Certify(half, 1, step > 0 ? near : kHullEdge);
  order_.CertifyAgain(Opposite(half));
  return true;
}

void TangentMotion::WalkDisplaced() {
  for (std::size_t i = 0; i < marks_.displaced().size(); ++i) {  // the list grows meanwhile
    const std::vector<HalfTangentId> halves = order_.corner(marks_.displaced()[i]).half_tangents;
    for (const HalfTangentId half : halves) {
      if (!hulls_.point(tangents_.Own(half)).corner || tangents_.StepAt(half) != 0) {
        Walk(TangentOf(half));
      }
    }
  }
  marks_.ClearDisplaced();
}

void TangentMotion::Walk(TangentId t) {
  const std::array<PointId, 2> from = tangents_.contacts(t);
  tangents_.Walk(t);
  for (const HalfTangentId half : {2 * t, 2 * t + 1}) {
    const PointId old = from[EndOf(half)];
    const PointId to = tangents_.Own(half);
    if (to == old) {
      if (!marks_.IsStale(to)) order_.CertifyAgain(half);
      continue;
    }
    marks_.MarkDisplaced(old);
    order_.Remove(old, half);
    order_.Insert(half);
    marks_.MarkStale(to);
    marks_.MarkForRecount(hulls_.ClusterOf(to));
  }
}

void TangentMotion::MarkBesideStale(PointId p) {
  if (!hulls_.point(p).corner) return;
  // A half tangent that defers to another has no certificate with an edge of the hull, and may have
  // crossed the edge together with the other.
  for (const HalfTangentId half : order_.corner(p).half_tangents) {
    const bool has_partner =
        certificates_.partner(half, 0) >= 0 || certificates_.partner(half, 1) >= 0;
    if (has_partner && tangents_.StepAt(half) != 0) {
      marks_.MarkDisplaced(p);
      break;
    }
  }
  if (!hulls_.now().whole) return;
  // Where points end, two half tangents may have changed places at p whose other ends are in line
  // with p for this one depth: then they do at the other ends, too.
  const std::span<const CornerOrder::Aimed> sorted = order_.Sort(p);
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    if (FilteredCrossSign(sorted[i - 1].first, sorted[i].first) != 0) continue;
    const PointId a = tangents_.Other(sorted[i - 1].second);
    const PointId b = tangents_.Other(sorted[i].second);
    if (!CollinearNow(p, a, b) || hulls_.Orient(p, a, b) == 0) continue;
    marks_.MarkStale(a);
    marks_.MarkStale(b);
  }
}

void TangentMotion::MarkCollinearEnd(HalfTangentId half) {
  const SweepDepth& now = hulls_.now();
  const PointId p = tangents_.Own(half);
  const PointId q = tangents_.Other(half);
  if (!now.whole || std::min(hulls_.point(p).end, hulls_.point(q).end) > now.s) return;
  const std::vector<HalfTangentId>& halves = order_.corner(p).half_tangents;
  const auto deferred_fails = [&](HalfTangentId other) {
    return (certificates_.partner(other, 0) == half && FailsNow(other, 0)) ||
           (certificates_.partner(other, 1) == half && FailsNow(other, 1));
  };
  if (!FailsNow(half, 0) && !FailsNow(half, 1) &&
      !(certificates_.HasDeferred(half) &&
        std::any_of(halves.begin(), halves.end(), deferred_fails))) {
    return;
  }
  MarkWithNeighbours(p);
  for (const HalfTangentId other : halves) {
    const PointId r = tangents_.Other(other);  // -1: dropped before, with its hull
    if (r >= 0 && CollinearNow(p, q, r)) marks_.MarkStale(r);
  }
}

// At a whole depth, not just after it.
bool TangentMotion::CollinearNow(PointId a, PointId b, PointId c) const {
  return OrientAt(hulls_.point(a).path, hulls_.point(b).path, hulls_.point(c).path,
                  hulls_.now().s) == 0;
}

bool TangentMotion::FailsNow(HalfTangentId half, std::size_t which) const {
  if (!certificates_.IsCertified(half, which)) return false;
  const auto& [a, b, c] = certificates_.points(half, which);
  return CollinearNow(a, b, c);
}

void TangentMotion::MarkWithNeighbours(PointId p) {
  for (const PointId near : {p, hulls_.point(p).prev, hulls_.point(p).next}) {
    if (near >= 0) marks_.MarkStale(near);
  }
}

}  // namespace farhorizon::kinetic

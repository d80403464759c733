// Bitangents by walking from corner to corner [Archambault03, section 3.2.2], with the signs of
// orientations just after now. The table is triangular: hulls of slots i < j have the four tangents
// from (j (j - 1) / 2 + i) * 4 on.
#include "core/horizon/kinetic/bitangents/tangent_table.h"

#include <algorithm>
#include <utility>

#include "core/base/result.h"

namespace farhorizon::kinetic {

namespace {

constexpr std::array<PointId, 2> kNotMade{-1, -1};

int Sense(HalfTangentId half) { return TangentTable::Ahead(half) ? 1 : -1; }

}  // namespace

void TangentTable::AddCluster(ClusterId c) {
  const auto free = std::find(clusters_.begin(), clusters_.end(), -1);
  const auto slot = static_cast<std::int32_t>(free - clusters_.begin());
  if (free == clusters_.end()) {
    const std::size_t count = clusters_.size() + 1;
    clusters_.push_back(c);
    contacts_.resize(count * (count - 1) / 2 * 4, kNotMade);
  } else {
    *free = c;
  }
  if (Index(c) >= slots_.size()) slots_.resize(Index(c) + 1, -1);
  slots_[Index(c)] = slot;
}

void TangentTable::RemoveCluster(ClusterId c) {
  clusters_[Index(SlotOf(c))] = -1;
  slots_[Index(c)] = -1;
}

TangentId TangentTable::First(ClusterId a, ClusterId b) const {
  const auto [i, j] = std::minmax({SlotOf(a), SlotOf(b)});
  return (j * (j - 1) / 2 + i) * 4;
}

void TangentTable::Make(ClusterId a, ClusterId b) {
  if (SlotOf(a) > SlotOf(b)) std::swap(a, b);
  const TangentId first = First(a, b);
  for (TangentId t = first; t < first + 4; ++t) {
    contacts_[Index(t)] = {hulls_.hull(a).corners[0], hulls_.hull(b).corners[0]};
    Walk(t);
  }
}

void TangentTable::Drop(TangentId first) {
  for (TangentId t = first; t < first + 4; ++t) contacts_[Index(t)] = kNotMade;
}

std::array<Arc, 2> TangentTable::ArcsAtEnd(TangentId first, std::int32_t end) {
  std::array<Arc, 2> arcs;
  for (HalfTangentId half = 2 * first + end; half < 2 * (first + 4); half += 2) {
    Arc& arc = arcs[Ahead(half) ? 0 : 1];
    (Starts(half) ? arc.start : arc.end) = half;
  }
  return arcs;
}

std::array<Arc, 2> TangentTable::ArcsAt(ClusterId c, ClusterId other) const {
  return ArcsAtEnd(First(c, other), SlotOf(c) < SlotOf(other) ? 0 : 1);
}

// Where the tangent stays in line with an edge of its own hull, the hull occludes the edge: a start
// is before it, an end after it. So what a hull occludes contains what its parts did, whatever is
// in line.
int TangentTable::StepAt(HalfTangentId half) const {
  const PointId p = Own(half);
  const PointId q = Other(half);
  const int next = Sense(half) * hulls_.Orient(p, q, hulls_.point(p).next);
  if (next < 0) return 1;
  const int prev = Sense(half) * hulls_.Orient(hulls_.point(p).prev, p, q);
  if (prev < 0) return -1;
  return Starts(half) ? (prev == 0 ? -1 : 0) : (next == 0 ? 1 : 0);
}

bool TangentTable::Supports(TangentId t) const {
  const auto [p, q] = contacts(t);
  return hulls_.point(p).corner && hulls_.point(q).corner && StepAt(2 * t) == 0 &&
         StepAt(2 * t + 1) == 0;
}

// Each round turns the line one way, so the walk ends. An end that is no corner any more begins at
// one that was beside it.
void TangentTable::Walk(TangentId t) {
  std::array<PointId, 2>& ends = contacts_[Index(t)];
  for (PointId& p : ends) {
    const KineticPoint& old = hulls_.point(p);
    if (old.corner) continue;
    const ClusterId c = hulls_.Find(old.cluster);
    p = hulls_.hull(c).corners[0];
    for (const PointId near : {old.next, old.prev}) {
      if (near >= 0 && hulls_.point(near).corner && hulls_.ClusterOf(near) == c) p = near;
    }
  }
  // Any number above the corners of two hulls is sound: a walk that does not end is a mistake here.
  constexpr std::int64_t kMostSteps = 100'000'000;
  std::int64_t steps = 0;
  for (bool moved = true; moved;) {
    moved = false;
    for (const HalfTangentId half : {2 * t, 2 * t + 1}) {
      while (const int step = StepAt(half)) {
        const KineticPoint& corner = hulls_.point(Own(half));
        MoveTo(half, step > 0 ? corner.next : corner.prev);
        moved = true;
        Check(++steps < kMostSteps, "the walk to a tangent ends");
      }
    }
  }
}

bool TangentTable::Before(HalfTangentId a, HalfTangentId b) const {
  const int turn = Sense(a) * Sense(b) * hulls_.Orient(Own(a), Other(a), Other(b));
  if (turn != 0) return turn > 0;
  return Starts(a) != Starts(b) ? Starts(a) : a < b;
}

bool TangentTable::HasWidth(PointId p, HalfTangentId before, HalfTangentId after) const {
  if (before == kHullEdge && after == kHullEdge) return true;
  if (before == kHullEdge) {
    return Sense(after) * hulls_.Orient(hulls_.point(p).prev, p, Other(after)) > 0;
  }
  if (after == kHullEdge) {
    return Sense(before) * hulls_.Orient(p, Other(before), hulls_.point(p).next) > 0;
  }
  return Sense(before) * Sense(after) * hulls_.Orient(p, Other(before), Other(after)) > 0;
}

void TangentTable::CheckTangents(ClusterId a, ClusterId b) const {
  const TangentId first = First(a, b);
  for (TangentId t = first; t < first + 4; ++t) Check(Supports(t), "tangents support their hulls");
}

}  // namespace farhorizon::kinetic

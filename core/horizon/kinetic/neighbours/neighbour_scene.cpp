// The conductor of algorithm 3.1 of [Archambault03], with the tangents of neighbours only: the
// numbered steps of neighbour_scene.h. Cost of an event: O(h) for each changed hull of h corners,
// O(m) for each octagon that grew among m hulls, and for each corner that is asked about O(m + c
// log h) for a cover of c hulls.
#include "core/horizon/kinetic/neighbours/neighbour_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/base/result.h"
#include "core/horizon/kinetic/hulls/hull_location.h"
#include "core/horizon/kinetic/neighbours/free_line.h"
#include "core/horizon/kinetic/neighbours/line_pencil.h"

namespace farhorizon::kinetic {

namespace {

struct Place {
  double x;
  double y;
};

Place PlaceAt(const MovingPoint& p, double s) {
  const auto d = static_cast<double>(p.d);
  return {(static_cast<double>(p.x) + static_cast<double>(p.vx) * s) / d,
          (static_cast<double>(p.y) + static_cast<double>(p.vy) * s) / d};
}

}  // namespace

PointId NeighbourScene::Add(ClusterId cluster, const MovingPoint& path, std::int64_t end,
                            std::int32_t tag) {
  on_horizon_.push_back(false);
  return hulls_.Add(cluster, path, end, tag);
}

ClusterId NeighbourScene::NewCluster() {
  boxes_.emplace_back();
  is_grown_.push_back(false);
  recent_.emplace_back();
  tangents_.AddCluster();
  return hulls_.NewCluster();
}

ClusterId NeighbourScene::Join(ClusterId a, ClusterId b) {
  a = Find(a);
  b = Find(b);
  if (a == b) return a;
  if (hulls_.hull(a).corners.size() < hulls_.hull(b).corners.size()) std::swap(a, b);
  ++counts_.merges;
  tangents_.DropAllOf(b);
  for (const TangentId t : tangents_.Of(a)) failed_tangents_.push_back(t);
  boxes_[Index(a)].Add(boxes_[Index(b)]);
  MarkGrown(a);
  recent_[Index(b)] = {};
  hulls_.Join(a, b);
  return a;
}

void NeighbourScene::Remove(PointId p) {
  queue_.Cancel(CertificateKind::kCover, p);
  hulls_.Remove(p);
}

void NeighbourScene::Advance(const SweepDepth& now) {
  hulls_.AdvanceTo(now);
  while (const std::optional<Event> event = queue_.PopAt(now)) {
    if (hulls_.Fail(*event, counts_)) continue;
    if (event->kind == CertificateKind::kTangent) {
      ++counts_.separation_failures;
      failed_tangents_.push_back(event->id);
    } else {
      ++counts_.cover_failures;
      failed_covers_.push_back(event->id);
    }
  }
}

void NeighbourScene::RestoreInvariants() {
  do {
    UpdateHulls();
  } while (JoinIntersecting());
  counts_.clusters_max =
      std::max(counts_.clusters_max, static_cast<std::int64_t>(hulls_.clusters().size()));
  counts_.tangents_max = std::max(counts_.tangents_max, tangents_.count());
  FindVisualGaps();
  hulls_.LocateInteriorPoints();
}

void NeighbourScene::UpdateHulls() {
  for (const ClusterId c : hulls_.TakeOutdated()) {
    if (Find(c) != c) continue;
    counts_.left_interior += hulls_.UpdateHull(c);
    updated_.push_back(c);
  }
}

bool NeighbourScene::JoinIntersecting() {
  for (const ClusterId c : std::exchange(updated_, {})) {
    GrowBox(c);
    for (const TangentId t : tangents_.Of(c)) {
      const SeparatingTangent& tangent = tangents_.tangent(t);
      const PointId own = tangent.a == c ? tangent.p : tangent.q;
      if (marks_.IsDisplaced(own)) failed_tangents_.push_back(t);
    }
  }
  return RestoreTangents() || JoinNeighbours();
}

// The octagon contains the whole ways of the corners, so it contains the hull until that gets
// other corners.
void NeighbourScene::GrowBox(ClusterId c) {
  PlanBox& box = boxes_[Index(c)];
  bool grown = false;
  for (const PointId p : hulls_.corners(c)) {
    if (!marks_.IsDisplaced(p)) continue;
    const KineticPoint& corner = hulls_.point(p);
    const Place from = PlaceAt(corner.path, std::floor(hulls_.now().lo));
    grown = box.Add(from.x, from.y) || grown;
    if (corner.path.vx == 0 && corner.path.vy == 0) continue;
    if (corner.end == kNever) {
      box.AddAll();
      grown = true;
    } else {
      const Place to = PlaceAt(corner.path, static_cast<double>(corner.end));
      grown = box.Add(to.x, to.y) || grown;
    }
  }
  if (grown) MarkGrown(c);
}

void NeighbourScene::MarkGrown(ClusterId c) {
  if (is_grown_[Index(c)]) return;
  is_grown_[Index(c)] = true;
  grown_.push_back(c);
}

// Each hull whose octagon grew is held against all others; one that was joined meanwhile is again.
bool NeighbourScene::JoinNeighbours() {
  while (!grown_.empty() && !OverBudget()) {
    const ClusterId c = grown_.back();
    grown_.pop_back();
    is_grown_[Index(c)] = false;
    if (Find(c) != c) continue;
    counts_.looks += static_cast<std::int64_t>(hulls_.clusters().size());
    for (const ClusterId other : hulls_.clusters()) {
      if (other == c || !box(c).Intersects(box(other)) || tangents_.Exists(c, other)) continue;
      if (HullsIntersect(hulls_, c, other)) {
        Join(c, other);
        return true;
      }
      tangents_.Make(c, other);
    }
  }
  return false;
}

bool NeighbourScene::RestoreTangents() {
  while (!failed_tangents_.empty()) {
    const TangentId t = failed_tangents_.back();
    failed_tangents_.pop_back();
    const SeparatingTangent tangent = tangents_.tangent(t);
    if (tangent.a < 0 || tangents_.Restore(t)) continue;
    Join(tangent.a, tangent.b);
    return true;
  }
  return false;
}

void NeighbourScene::FindVisualGaps() {
  for (const PointId p : marks_.displaced()) AskCorner(p);
  for (const PointId p : failed_covers_) {
    if (!marks_.IsDisplaced(p)) AskCorner(p);
  }
  failed_covers_.clear();
  marks_.ClearDisplaced();
  marks_.ClearStale();
}

// First the hulls that occluded corners of the hull last; then those on a line that these leave
// free, until there is none, or a line that meets no octagon.
void NeighbourScene::AskCorner(PointId p) {
  const KineticPoint& corner = hulls_.point(p);
  queue_.Cancel(CertificateKind::kCover, p);
  if (!corner.corner || corner.tag < 0 || OnHorizon(p) || OverBudget()) return;
  const ClusterId own = hulls_.ClusterOf(p);
  LinePencil<KineticHulls> pencil(hulls_, corner.path, hulls_.path(corner.prev),
                                  hulls_.path(corner.next));
  std::vector<ClusterId>& recent = recent_[Index(own)];
  for (const ClusterId c : recent) {
    const ClusterId now = Find(c);
    if (now != own && !pencil.Has(now)) pencil.Add(now);
  }
  counts_.looks += static_cast<std::int64_t>(pencil.hull_count()) + 1;
  const Place at = PlaceAt(corner.path, hulls_.now().lo);
  const bool is_placed = hulls_.now().hi - hulls_.now().lo < PlanBox::kMargin / 2;
  const auto box_of = [this](ClusterId c) -> const PlanBox& { return box(c); };
  if (FindFreeLine(pencil, {hulls_.clusters(), own, at.x, at.y, is_placed}, box_of,
                   counts_.looks)) {
    on_horizon_[Index(p)] = true;
    return;
  }
  recent = pencil.cover();
  queue_.Schedule(CertificateKind::kCover, p, pencil.FailureBefore(corner.end));
}

void NeighbourScene::CheckAll() const {
  hulls_.CheckPoints();
  for (const ClusterId c : hulls_.clusters()) {
    hulls_.CheckHull(c);
    for (const ClusterId other : hulls_.clusters()) {
      if (other != c) Check(!HullsIntersect(hulls_, c, other), "hulls are disjoint");
    }
    for (const TangentId t : tangents_.Of(c)) tangents_.CheckTangent(t);
    for (const PointId p : hulls_.corners(c)) {
      const KineticPoint& corner = hulls_.point(p);
      if (corner.tag < 0 || OnHorizon(p)) continue;
      LinePencil<KineticHulls> pencil(hulls_, corner.path, hulls_.path(corner.prev),
                                      hulls_.path(corner.next));
      for (const ClusterId other : hulls_.clusters()) {
        if (other != c) pencil.Add(other);
      }
      Check(!pencil.FindGap(), "corners with a visual gap are known to be on the horizon");
    }
  }
}

}  // namespace farhorizon::kinetic

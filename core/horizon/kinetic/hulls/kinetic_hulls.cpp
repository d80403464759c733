// Kinetic convex hulls: where a corner's certificate failed the ring of corners is mended
// (corner_ring.h); a fan of triangles for the interior points [Archambault03, section 3.2.4].
#include "core/horizon/kinetic/hulls/kinetic_hulls.h"

#include <algorithm>
#include <utility>

#include "core/base/result.h"
#include "core/geometry/union_find.h"
#include "core/horizon/kinetic/hulls/corner_ring.h"
#include "core/horizon/kinetic/hulls/hull_location.h"

namespace farhorizon::kinetic {

PointId KineticHulls::Add(ClusterId cluster, const MovingPoint& path, std::int64_t end,
                          std::int32_t tag) {
  const auto id = static_cast<PointId>(points_.size());
  KineticPoint& p = points_.emplace_back();
  marks_.AddPoint();
  p.path = path;
  p.end = end;
  p.tag = tag;
  p.cluster = Find(cluster);
  hulls_[Index(p.cluster)].unlocated.push_back(id);
  MarkChanged(p.cluster);
  return id;
}

ClusterId KineticHulls::NewCluster() {
  const auto id = static_cast<ClusterId>(hulls_.size());
  KineticHull& hull = hulls_.emplace_back();
  marks_.AddCluster();
  if (forest_) forest_->AddCluster();
  roots_.push_back(id);
  clusters_.push_back(id);
  hull.corners_stale = true;
  hull.is_new = true;
  MarkChanged(id);
  return id;
}

void KineticHulls::Remove(PointId p) {
  KineticPoint& gone = points_[Index(p)];
  gone.alive = false;
  queue_.Cancel(CertificateKind::kInterior, p);
  if (gone.corner) InvalidateCorners(p);
  if (!forest_) return;
  forest_->Erase(p);
  MarkChanged(ClusterOf(p));
}

void KineticHulls::Join(ClusterId kept, ClusterId lost) {
  KineticHull& to = hulls_[Index(kept)];
  KineticHull& from = hulls_[Index(lost)];
  for (const PointId p : from.corners) points_[Index(p)].cluster = kept;
  to.corners.insert(to.corners.end(), from.corners.begin(), from.corners.end());
  to.unlocated.insert(to.unlocated.end(), from.unlocated.begin(), from.unlocated.end());
  to.corners_stale = true;
  to.joined = true;
  from = {};
  if (forest_) forest_->Join(kept, lost);
  roots_[Index(lost)] = kept;
  clusters_.erase(std::find(clusters_.begin(), clusters_.end(), lost));
  MarkChanged(kept);
}

ClusterId KineticHulls::Find(ClusterId cluster) const { return FindRoot(roots_, cluster); }

void KineticHulls::InvalidateCorners(PointId p) {
  const ClusterId c = ClusterOf(p);
  hulls_[Index(c)].corners_stale = true;
  MarkChanged(c);
}

bool KineticHulls::Fail(const Event& event, SceneCounts& counts) {
  switch (event.kind) {
    case CertificateKind::kHull:
      ++counts.hull_failures;
      InvalidateCorners(event.id);
      return true;
    case CertificateKind::kTree:
      ++counts.hull_failures;
      MarkChanged(forest_->Fail(event.id));
      return true;
    case CertificateKind::kInterior:
      ++counts.interior_failures;
      InvalidateTriangle(event.id);
      return true;
    case CertificateKind::kTangent:
    case CertificateKind::kCover:
      break;
  }
  return false;
}

void KineticHulls::InvalidateTriangle(PointId p) {
  const ClusterId c = ClusterOf(p);
  hulls_[Index(c)].unlocated.push_back(p);
  MarkChanged(c);
}

void KineticHulls::MarkChanged(ClusterId c) {
  KineticHull& hull = hulls_[Index(c)];
  if (!std::exchange(hull.outdated, true)) outdated_.push_back(c);
  if (!std::exchange(hull.changed, true)) changed_.push_back(c);
}

std::int64_t KineticHulls::UpdateHull(ClusterId c) {
  hulls_[Index(c)].outdated = false;
  if (forest_) {
    SetCorners(c, CornersByTree(c));
    return 0;
  }
  std::optional<std::vector<PointId>> ring = CornersByTurns(c);
  if (!ring) return 0;
  // A candidate that is no corner, but once had a certificate, has just failed it.
  const std::int64_t left_interior = std::count_if(ring->begin(), ring->end(), [this](PointId p) {
    return !point(p).corner && queue_.WasUsed(CertificateKind::kInterior, p);
  });
  SetCorners(c, *std::move(ring));
  return left_interior;
}

std::vector<PointId> KineticHulls::CornersByTree(ClusterId c) {
  KineticHull& hull = hulls_[Index(c)];
  hull.corners_stale = hull.joined = false;
  for (const PointId p : std::exchange(hull.unlocated, {})) {
    if (!point(p).alive) continue;
    points_[Index(p)].cluster = c;
    forest_->Insert(c, p);
  }
  forest_->Update(c, points_, now_);
  std::vector<PointId> ring = forest_->Corners(c);
  RemoveReflex(*this, ring);  // of points that are one for ever, each chain has one of its own
  Check(ring.size() >= 3, "the ground just below a post has a width");
  return ring;
}

// The ring of corners is mended; only a hull that is new, or made of two, is found from its points.
// nullopt: nothing has changed.
std::optional<std::vector<PointId>> KineticHulls::CornersByTurns(ClusterId c) {
  KineticHull& hull = hulls_[Index(c)];
  std::vector<PointId> candidates = std::exchange(hull.unlocated, {});
  std::erase_if(candidates, [this](PointId p) { return !point(p).alive; });
  for (const PointId p : candidates) points_[Index(p)].cluster = c;
  interior_points_.insert(interior_points_.end(), candidates.begin(), candidates.end());
  bool changes = std::exchange(hull.corners_stale, false);
  const bool apart = std::exchange(hull.joined, false) || hull.is_new;
  std::vector<PointId> ring = hull.corners;
  if (changes) {
    std::erase_if(ring, [this](PointId p) { return !point(p).alive; });
    if (!apart) RemoveReflex(*this, ring);
  }
  const auto found_anew = [&] {
    candidates.insert(candidates.end(), hull.corners.begin(), hull.corners.end());
    std::erase_if(candidates, [this](PointId p) { return !point(p).alive; });
    return HullOf(*this, std::move(candidates));
  };
  if (apart || ring.size() < 3) return found_anew();
  for (const PointId p : candidates) changes = AddOutside(*this, p, ring) || changes;
  if (!changes) return std::nullopt;
  // Corners that met, as those of terrain never do, may be out of order.
  for (std::size_t i = 0; i < ring.size(); ++i) {
    points_[Index(ring[i])].index = static_cast<std::int32_t>(i);
  }
  const bool all_inside = std::all_of(hull.corners.begin(), hull.corners.end(), [&](PointId p) {
    const auto index = static_cast<std::size_t>(point(p).index);
    const bool stays = index < ring.size() && ring[index] == p;
    return stays || !point(p).alive || TriangleAround(*this, ring, path(p));
  });
  if (!all_inside) return found_anew();
  return ring;
}

void KineticHulls::SetCorners(ClusterId c, std::vector<PointId> corners) {
  KineticHull& hull = hulls_[Index(c)];
  if (corners == hull.corners && !hull.is_new) return;
  const std::vector<PointId> old = std::exchange(hull.corners, std::move(corners));
  marks_.MarkForRecount(c);
  const std::size_t n = hull.corners.size();
  for (std::size_t i = 0; i < n; ++i) {
    const PointId p = hull.corners[i];
    const PointId prev = hull.corners[(i + n - 1) % n];
    const PointId next = hull.corners[(i + 1) % n];
    KineticPoint& corner = points_[Index(p)];
    corner.cluster = c;
    corner.index = static_cast<std::int32_t>(i);
    if (corner.corner && corner.prev == prev && corner.next == next && !hull.is_new) continue;
    corner.prev = prev;
    corner.next = next;
    queue_.Cancel(CertificateKind::kInterior, p);
    marks_.MarkDisplaced(p);
    if (forest_) continue;
    queue_.Schedule(CertificateKind::kHull, p,
                    TurnFailureAfter({point(prev).path, corner.path, point(next).path}, 1, now_,
                                     FirstEnd({prev, p, next})));
  }
  for (const PointId p : old) points_[Index(p)].corner = false;
  for (const PointId p : hull.corners) points_[Index(p)].corner = true;
  for (const PointId p : old) {
    if (point(p).corner) continue;
    queue_.Cancel(CertificateKind::kHull, p);
    marks_.MarkDisplaced(p);
    if (point(p).alive) interior_points_.push_back(p);
  }
}

void KineticHulls::LocateInteriorPoints() {
  for (const PointId p : interior_points_) LocateInterior(p);
  interior_points_.clear();
  for (const ClusterId c : changed_) {
    KineticHull& hull = hulls_[Index(c)];
    hull.changed = hull.is_new = false;
  }
  changed_.clear();
}

// The certificate ends with the triangle: where a corner of it is removed, or the point meets a
// side.
void KineticHulls::LocateInterior(PointId p) {
  KineticPoint& inner = points_[Index(p)];
  if (!inner.alive || inner.corner || forest_) return;
  const ClusterId c = Find(inner.cluster);
  inner.cluster = c;
  // Hulls only grow: a point that ends inside, or does not move, never comes out.
  const bool stays = inner.path.vx == 0 && inner.path.vy == 0;
  if (stays || TriangleAround(*this, corners(c), inner.path.At(inner.end))) {
    inner.alive = false;
    queue_.Cancel(CertificateKind::kInterior, p);
    return;
  }
  const auto triangle = TriangleAround(*this, corners(c), inner.path);
  Check(triangle.has_value(), "a point that is no corner is in its hull");
  const std::int64_t end = std::min(inner.end, FirstEnd(*triangle));
  Check(Compare(SweepDepth::At(end), now_) > 0, "points are removed where they end");
  std::optional<SweepDepth> first;
  if (end < inner.end) first = SweepDepth::At(end);
  for (std::size_t i = 0; i < 3; ++i) {
    const MovingPoint& from = point((*triangle)[i]).path;
    const MovingPoint& to = point((*triangle)[(i + 1) % 3]).path;
    const std::optional<SweepDepth> at = TurnFailureAfter({from, to, inner.path}, 1, now_, end);
    if (at && (!first || Compare(*at, *first) < 0)) first = at;
  }
  queue_.Schedule(CertificateKind::kInterior, p, first);
}

std::int64_t KineticHulls::FirstEnd(const std::array<PointId, 3>& points) const {
  return std::min({point(points[0]).end, point(points[1]).end, point(points[2]).end});
}

void KineticHulls::CheckHull(ClusterId c) const {
  for (const PointId p : hull(c).corners) {
    Check(Orient(point(p).prev, p, point(p).next) > 0, "corners are strictly convex");
  }
}

void KineticHulls::CheckPoints() const {
  for (const KineticPoint& p : points_) {
    if (!p.alive || p.corner) continue;
    Check(TriangleAround(*this, corners(Find(p.cluster)), p.path).has_value(),
          "points are in their hulls");
  }
}

}  // namespace farhorizon::kinetic

// The queue of certificates and the step from one moment to the next (algorithm 3.1).
#include "core/horizon/kinetic/scene.h"

#include <algorithm>
#include <utility>

#include "core/base/result.h"

namespace farhorizon::kinetic {

PointId Scene::Add(ClusterId cluster, const MovingPoint& path, std::int64_t end, std::int32_t tag) {
  const auto id = static_cast<PointId>(points_.size());
  Point& p = points_.emplace_back();
  p.path = path;
  p.end = end;
  p.tag = tag;
  p.cluster = Find(cluster);
  clusters_[Index(p.cluster)].loose.push_back(id);
  List(p.cluster);
  return id;
}

ClusterId Scene::NewCluster() {
  const auto id = static_cast<ClusterId>(clusters_.size());
  Cluster& c = clusters_.emplace_back();
  roots_.push_back(id);
  apart_.push_back(id);
  const auto free = std::find(in_slot_.begin(), in_slot_.end(), -1);
  c.slot = static_cast<std::int32_t>(free - in_slot_.begin());
  if (free == in_slot_.end()) {
    const std::size_t slots = in_slot_.size() + 1;
    in_slot_.push_back(id);
    tangents_.resize(slots * (slots - 1) / 2 * 4);
  } else {
    *free = id;
  }
  c.dirty = true;
  c.fresh = true;
  List(id);
  return id;
}

ClusterId Scene::Find(ClusterId cluster) {
  while (roots_[Index(cluster)] != cluster) {
    ClusterId& root = roots_[Index(cluster)];
    root = roots_[Index(root)];
    cluster = root;
  }
  return cluster;
}

ClusterId Scene::Join(ClusterId a, ClusterId b) {
  a = Find(a);
  b = Find(b);
  if (a == b) return a;
  if (cluster(a).corners.size() < cluster(b).corners.size()) std::swap(a, b);
  ++counts_.merges;
  Cluster& kept = clusters_[Index(a)];
  Cluster& lost = clusters_[Index(b)];
  kept.fresh = lost.fresh = true;
  for (const ClusterId other : apart_) {
    if (other != a) DropTangents(a, other);
    if (other != b && other != a) DropTangents(b, other);
  }
  for (const Cluster* joined : {&kept, &lost}) {
    for (const PointId p : joined->corners) {
      points_[Index(p)].sides.clear();
      points_[Index(p)].lit.clear();
    }
  }
  for (const PointId p : lost.corners) points_[Index(p)].cluster = a;
  kept.corners.insert(kept.corners.end(), lost.corners.begin(), lost.corners.end());
  kept.loose.insert(kept.loose.end(), lost.loose.begin(), lost.loose.end());
  kept.dirty = true;
  in_slot_[Index(lost.slot)] = -1;
  lost = Cluster();
  roots_[Index(b)] = a;
  apart_.erase(std::find(apart_.begin(), apart_.end(), b));
  List(a);
  return a;
}

void Scene::Remove(PointId p) {
  Point& gone = points_[Index(p)];
  gone.alive = false;
  Cancel(gone.inside);
  if (!gone.corner) return;
  const ClusterId c = Find(gone.cluster);
  clusters_[Index(c)].dirty = true;
  List(c);
}

Certificate& Scene::CertificateOf(Promise promise, std::int32_t id) {
  switch (promise) {
    case Promise::kHull:
      return points_[Index(id)].hull;
    case Promise::kInside:
      return points_[Index(id)].inside;
    case Promise::kTangent:
      break;
  }
  return SideOf(id / 2).certificates[id % 2 ? 1 : 0];
}

void Scene::Cancel(Certificate& certificate) {
  if (certificate.pending) --live_;
  certificate.pending = false;
  ++certificate.stamp;
}

void Scene::Schedule(Promise promise, std::int32_t id, const std::optional<Moment>& at) {
  Certificate& certificate = CertificateOf(promise, id);
  Cancel(certificate);
  if (!at) return;
  certificate.pending = true;
  ++live_;
  counts_.queue_max = std::max(counts_.queue_max, live_);
  queue_.push({*at, promise, certificate.stamp, id});
}

std::optional<Moment> Scene::NextFailure() {
  while (!queue_.empty()) {
    const Failure& next = queue_.top();
    if (CertificateOf(next.promise, next.id).stamp == next.stamp) return next.at;
    queue_.pop();
  }
  return std::nullopt;
}

void Scene::Advance(const Moment& now) {
  now_ = now;
  for (std::optional<Moment> next = NextFailure(); next; next = NextFailure()) {
    const int order = Compare(*next, now);
    Check(order >= 0, "no certificate has failed unnoticed");
    if (order > 0) break;
    const Failure failed = queue_.top();
    queue_.pop();
    Cancel(CertificateOf(failed.promise, failed.id));
    Fail(failed.promise, failed.id);
  }
}

void Scene::Fail(Promise promise, std::int32_t id) {
  if (promise == Promise::kHull) {
    ++counts_.hull_failures;
    const ClusterId c = Find(point(id).cluster);
    clusters_[Index(c)].dirty = true;
    List(c);
  } else if (promise == Promise::kInside) {
    ++counts_.inside_failures;
    const ClusterId c = Find(point(id).cluster);
    clusters_[Index(c)].loose.push_back(id);
    List(c);
  } else {
    FailTangent(id / 2, static_cast<std::size_t>(id % 2));
  }
}

void Scene::FailTangent(SideId id, std::size_t which) {
  Tangent::Side& side = SideOf(id);
  const SideId with = side.with[which];
  const std::array<PointId, 3> points = side.keys[which].points;
  side.keys[which] = {};
  if (with >= 0) {
    const int active = (side.active ? 1 : 0) + (Active(with) ? 1 : 0);
    ++(active == 0 ? counts_.hanging_failures : counts_.tangent_failures[active == 2 ? 0 : 1]);
    passed_.push_back({id, which, with, points});
    return;
  }
  ++counts_.tangent_failures[side.active ? 2 : 3];
  if (side.active) {
    for (const PointId p : points) Shake(p);
  } else {
    crossed_.emplace_back(id, Own(id));
  }
}

void Scene::Touch(PointId p) {
  Point& touched = points_[Index(p)];
  if (touched.touched) return;
  touched.touched = true;
  touched_.push_back(p);
}

void Scene::TouchAround(PointId p) {
  for (const PointId near : {p, point(p).prev, point(p).next}) {
    if (near >= 0) Touch(near);
  }
}

void Scene::Shake(PointId p) {
  Touch(p);
  Point& shaken = points_[Index(p)];
  if (shaken.shaken) return;
  shaken.shaken = true;
  shaken_.push_back(p);
}

void Scene::List(ClusterId c) {
  Cluster& listed = clusters_[Index(c)];
  if (listed.listed) return;
  listed.listed = true;
  listed_.push_back(c);
}

std::int64_t Scene::FirstEnd(PointId a, PointId b, PointId c) const {
  return std::min({point(a).end, point(b).end, point(c).end});
}

void Scene::Settle() {
  do {
    for (std::size_t i = 0; i < listed_.size(); ++i) {
      if (Find(listed_[i]) == listed_[i]) SettleHull(listed_[i]);
    }
  } while (MergeWhatMeets());
  counts_.clusters_max = std::max(counts_.clusters_max, static_cast<std::int64_t>(apart_.size()));
  UpdateTangents();
  for (const PointId p : unsettled_) KeepInside(p);
  unsettled_.clear();
  for (const ClusterId c : listed_) {
    Cluster& listed = clusters_[Index(c)];
    listed.listed = listed.fresh = false;
  }
  listed_.clear();
}

}  // namespace farhorizon::kinetic

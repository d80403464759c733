#include "core/horizon/kinetic/bitangents/occlusion_depths.h"

#include <cstdint>

namespace farhorizon::kinetic {

void OcclusionDepths::Occlude(const Arc& arc) {
  const PointId last = tangents_.Own(arc.end);
  PointId p = tangents_.Own(arc.start);
  if (marks_.NeedsRecount(hulls_.ClusterOf(p))) {
    // A corner on the way may be as deep as before and yet be occluded where it was not: all along
    // by this hull, where an arc of one that is part of it now ended.
    marks_.MarkStale(last);
    for (marks_.MarkStale(p); p != last; p = hulls_.point(p).next) {
      if (!order_.corner(p).active_bitangents.empty()) marks_.MarkStale(p);
    }
    return;
  }
  for (bool first = true;; first = false, p = hulls_.point(p).next) {
    order_.Occlude(p, first ? arc.start : kHullEdge, p == last ? arc.end : kHullEdge);
    if (!first) order_.AddToDepth(p, 1);
    if (p == last) return;
  }
}

void OcclusionDepths::Drop(const Arc& arc) {
  dropped_.emplace_back(tangents_.Own(arc.start), tangents_.Own(arc.end));
}

void OcclusionDepths::ReleaseDropped() {
  for (const auto& [from, last] : dropped_) {
    if (marks_.NeedsRecount(hulls_.ClusterOf(from))) continue;
    for (PointId p = from; p != last;) {
      p = hulls_.point(p).next;
      order_.AddToDepth(p, -1);
    }
  }
  dropped_.clear();
}

void OcclusionDepths::Recount(ClusterId c) {
  const std::vector<PointId>& ring = hulls_.hull(c).corners;
  changes_.assign(ring.size() + 1, 0);  // of the depth, from the corner before
  for (const ClusterId other : hulls_.clusters()) {
    if (other == c) continue;
    for (const Arc& arc : tangents_.ArcsAt(c, other)) {
      const std::int32_t from = hulls_.point(tangents_.Own(arc.start)).index;
      const std::int32_t to = hulls_.point(tangents_.Own(arc.end)).index;
      ++changes_[Index(from + 1)];
      --changes_[Index(to + 1)];
      if (from > to) ++changes_[0];  // the arc goes on past the last corner
    }
  }
  int depth = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    depth += changes_[i];
    const Corner& corner = order_.corner(ring[i]);
    if (corner.depth == depth) continue;
    if (corner.depth == 0 || depth == 0 || !corner.active_bitangents.empty()) {
      marks_.MarkStale(ring[i]);
    }
    order_.AddToDepth(ring[i], depth - corner.depth);
  }
}

}  // namespace farhorizon::kinetic

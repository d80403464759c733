#include "core/horizon/sweep/hull_scene.h"

#include <utility>

namespace farhorizon {

void HullScene::Apply(const HullChange& change) {
  if (change.kind == HullChange::Kind::kBirth) {
    hulls_.emplace_back(change.post);
    index_.Add(hulls_.back());
    return;
  }
  ConvexPolygon& hull = hulls_[static_cast<std::size_t>(change.hull)];
  if (change.kind == HullChange::Kind::kGrowth) {
    hull.Extend(change.post);
    index_.Grow(change.hull, hull);
    return;
  }
  std::vector<Point2i> corners = hull.corners();
  ConvexPolygon& lost = hulls_[static_cast<std::size_t>(change.other)];
  corners.insert(corners.end(), lost.corners().begin(), lost.corners().end());
  hull = ConvexPolygon::HullOf(corners);
  index_.Grow(change.hull, hull);
  index_.Drop(change.other);
  std::swap(lost, hulls_.back());
  hulls_.pop_back();
}

}  // namespace farhorizon

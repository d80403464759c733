#include "core/horizon/hull_scene.h"

#include <utility>

namespace farhorizon {

void HullScene::Apply(const HullChange& change) {
  if (change.kind == HullChange::Kind::kBirth) {
    hulls_.emplace_back(change.post);
    return;
  }
  ConvexPolygon& hull = hulls_[static_cast<std::size_t>(change.hull)];
  if (change.kind == HullChange::Kind::kGrowth) {
    hull.Extend(change.post);
    return;
  }
  std::vector<Point2i> corners = hull.corners();
  ConvexPolygon& lost = hulls_[static_cast<std::size_t>(change.other)];
  corners.insert(corners.end(), lost.corners().begin(), lost.corners().end());
  hull = ConvexPolygon::HullOf(corners);
  std::swap(lost, hulls_.back());
  hulls_.pop_back();
}

}  // namespace farhorizon

#include "core/horizon/sweep/hull_scene.h"

#include <utility>

namespace farhorizon {

void HullScene::Apply(const HullChange& change) {
  if (change.kind == HullChange::Kind::kStart) {
    hulls_.emplace_back(change.post);
    index_.Add(hulls_.back());
    return;
  }
  ConvexPolygon& hull = hulls_[static_cast<std::size_t>(change.hull)];
  if (change.kind == HullChange::Kind::kExtension) {
    hull.Extend(change.post);
    index_.Grow(change.hull, hull);
    return;
  }
  std::vector<Point2i> corners = hull.corners();
  ConvexPolygon& absorbed = hulls_[static_cast<std::size_t>(change.other)];
  corners.insert(corners.end(), absorbed.corners().begin(), absorbed.corners().end());
  hull = ConvexPolygon::HullOf(corners);
  index_.Grow(change.hull, hull);
  index_.Drop(change.other);
  std::swap(absorbed, hulls_.back());
  hulls_.pop_back();
}

}  // namespace farhorizon

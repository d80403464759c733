#include "core/horizon/sweep/hull_scene.h"

#include <utility>

namespace farhorizon {

HullScene::HullScene(std::int32_t columns, std::int32_t rows, const HullSnapshot& snapshot)
    : index_(columns, rows) {
  hulls_.reserve(snapshot.ends.size());
  std::uint32_t begin = 0;
  for (const std::uint32_t end : snapshot.ends) {
    hulls_.push_back(ConvexPolygon::FromCorners(
        {snapshot.corners.begin() + begin, snapshot.corners.begin() + end}));
    index_.Add(hulls_.back());
    begin = end;
  }
}

HullSnapshot HullScene::Snapshot() const {
  HullSnapshot snapshot;
  snapshot.ends.reserve(hulls_.size());
  for (const ConvexPolygon& hull : hulls_) {
    snapshot.corners.insert(snapshot.corners.end(), hull.corners().begin(), hull.corners().end());
    snapshot.ends.push_back(static_cast<std::uint32_t>(snapshot.corners.size()));
  }
  return snapshot;
}

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

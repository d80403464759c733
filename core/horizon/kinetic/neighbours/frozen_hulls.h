#pragma once

#include <cstdint>
#include <vector>

#include "core/horizon/kinetic/hulls/kinetic_hulls.h"
#include "core/horizon/kinetic/hulls/moving_point.h"

namespace farhorizon::kinetic {

/// The hulls of a scene as a whole depth is reached, before anything happens there. They stand;
/// what moves is a point along a horizontal edge, so `now` is how far along it is.
///
/// Corners that meet there, or come in line, are left out: each hull is strictly convex. Hulls are
/// numbered as in clusters() of the scene.
class FrozenHulls {
 public:
  /// Requires: no event is between `hulls.now()` and depth s; `hulls` outlives it. Cost: O(hulls).
  FrozenHulls(const KineticHulls& hulls, std::int64_t s)
      : hulls_(hulls), s_(s), rings_(hulls.clusters().size()), now_(SweepDepth::At(0)) {
    for (ClusterId c = 0; Index(c) < rings_.size(); ++c) clusters_.push_back(c);
  }

  [[nodiscard]] std::int64_t depth() const { return s_; }
  [[nodiscard]] const std::vector<ClusterId>& clusters() const { return clusters_; }
  /// Cost: O(h) for h corners, the first time.
  [[nodiscard]] const std::vector<PointId>& corners(ClusterId c) const;
  [[nodiscard]] const MovingPoint& path(PointId p) const { return paths_[Index(p)]; }
  [[nodiscard]] std::int64_t EndOf(PointId /*p*/) const { return kNever; }
  [[nodiscard]] const SweepDepth& now() const { return now_; }
  void AdvanceTo(const SweepDepth& now) { now_ = now; }

 private:
  const KineticHulls& hulls_;
  std::int64_t s_;
  std::vector<ClusterId> clusters_;
  mutable std::vector<std::vector<PointId>> rings_;  // empty until asked for
  mutable std::vector<MovingPoint> paths_;
  SweepDepth now_;
};

}  // namespace farhorizon::kinetic

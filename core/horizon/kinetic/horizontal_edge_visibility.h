#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "core/geometry/point.h"
#include "core/horizon/kinetic/hulls/moving_point.h"
#include "core/horizon/kinetic/hulls/plan_box.h"
#include "core/horizon/kinetic/neighbours/frozen_hulls.h"

namespace farhorizon::kinetic {

/// Which horizontal edges of one whole depth are horizon edges.
///
/// The scene knows the horizon at sloped edges between events. A horizontal edge is in the slice at
/// one depth only, and only higher ground occludes it: the hulls as the plane arrives there, before
/// anything of the edge's own height is added. These stand, and a point goes along the edge: at
/// each of its places the hulls leave a line free, or a cover (line_pencil.h) proves that they do
/// not, which holds until the point gets to where it fails.
///
/// Scene: NeighbourScene or BitangentScene.
template <typename Scene>
class HorizontalEdgeVisibility {
 public:
  /// Requires: the scene is past every event before depth s, and at none at s; it outlives this.
  HorizontalEdgeVisibility(const Scene& scene, std::int64_t s)
      : scene_(scene), hulls_(scene.hulls(), s) {}

  /// Whether the lines that cross the inside of the horizontal edge ab and miss all higher ground
  /// have interior points among the plan lines. Exact.
  [[nodiscard]] bool IsVisible(Point3i a, Point3i b);

  /// Hulls that were looked at since the last call: the work.
  std::int64_t TakeLooks() { return std::exchange(looks_, 0); }

 private:
  [[nodiscard]] std::optional<ClusterId> HullAround(const MovingPoint& p) const;
  [[nodiscard]] std::optional<SweepDepth> WayOutOf(ClusterId c, const MovingPoint& p) const;
  [[nodiscard]] const PlanBox& box(ClusterId c) const;

  const Scene& scene_;
  FrozenHulls hulls_;
  std::vector<ClusterId> recent_;  // that covered the last point
  std::int64_t looks_ = 0;
};

}  // namespace farhorizon::kinetic

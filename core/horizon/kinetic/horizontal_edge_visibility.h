#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/geometry/point.h"
#include "core/geometry/vector.h"
#include "core/horizon/kinetic/moving_point.h"
#include "core/horizon/kinetic/scene.h"

namespace farhorizon::kinetic {

/// The visual gaps of a scene at one whole depth, in the limit from above: which horizontal edges
/// of that height are horizon edges.
///
/// The scene knows the horizon at sloped edges between events. A horizontal edge is in the slice at
/// one depth only, and only higher ground occludes it: the hulls as the plane arrives there, before
/// anything of the edge's own height is added.
class HorizontalEdgeVisibility {
 public:
  /// Requires: the scene is past every event before depth s, and at none at s; it outlives this.
  /// Cost: corners, active bitangents and pairs of hulls.
  HorizontalEdgeVisibility(const Scene& scene, std::int64_t s);

  /// Whether the lines that cross the inside of the horizontal edge ab and miss all higher ground
  /// have interior points among the plan lines. Exact. Cost: the visual gaps of all hulls.
  [[nodiscard]] bool IsVisible(Point3i a, Point3i b) const;

 private:
  // The lines through a corner whose directions are strictly between two, counter-clockwise.
  struct VisualGap {
    MovingPoint corner;  // which does not move
    Vector from;
    Vector to;
  };
  [[nodiscard]] Vector Towards(PointId p, PointId q) const;
  [[nodiscard]] Vector DirectionOf(HalfTangentId half) const;
  [[nodiscard]] bool IsOnTheRight(const VisualGap& gap, ClusterId other) const;
  void AddVisualGaps(ClusterId c, PointId p);
  void AddVisualGap(ClusterId c, const VisualGap& gap);

  const Scene& scene_;
  std::int64_t s_;
  std::vector<std::pair<ClusterId, ClusterId>> touching_;  // hulls that have come to intersect
  std::vector<VisualGap> gaps_;
};

}  // namespace farhorizon::kinetic

#pragma once

#include <cstdint>
#include <vector>

#include "core/horizon/kinetic/scene.h"
#include "core/terrain/terrain.h"

namespace farhorizon::kinetic {

/// The lines of sight that touch a hull and are free at one whole depth, as it is reached: what level
/// edges of that height need. The scene knows sloped edges between events; a level edge lives at one
/// moment only, and is hidden by higher ground alone, so it is asked of the scene's limit there.
class LevelSight {
 public:
  /// scene: gone past every event before depth s, none at s. Cost: its corners, active tangents and pairs.
  LevelSight(const Scene& scene, std::int64_t s);

  /// Whether the lines that cross the inside of the level edge ab and miss all higher ground have
  /// interior points among the plan lines. Exact. Cost: the free stretches around all hulls.
  [[nodiscard]] bool Sees(Point3i a, Point3i b) const;

 private:
  struct Vector {
    Int128 x = 0;
    Int128 y = 0;
  };
  struct Gap {
    MovingPoint corner;
    Vector from;
    Vector to;
  };
  static int Cross(const Vector& a, const Vector& b);
  static int Dot(const Vector& a, const Vector& b);
  static bool Overlap(const Vector& a, const Vector& b, const Vector& from, const Vector& to);
  [[nodiscard]] Vector Towards(PointId p, PointId q) const;
  [[nodiscard]] Vector DirectionOf(SideId side) const;
  [[nodiscard]] bool OnTheRight(const Gap& gap, ClusterId other) const;
  void AddGaps(ClusterId c, PointId p);

  const Scene& scene_;
  std::int64_t s_;
  std::vector<std::pair<ClusterId, ClusterId>> touching_;
  std::vector<Gap> gaps_;
};

}  // namespace farhorizon::kinetic

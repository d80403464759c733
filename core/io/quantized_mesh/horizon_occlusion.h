#pragma once

#include <optional>
#include <vector>

#include "core/geo/frames.h"

namespace farhorizon {

/// A sphere, earth-fixed, metres.
struct BoundingSphere {
  Ecef centre;
  double radius_m = 0;
};

/// The sphere about the middle of the points' box, of the least radius that holds them all.
/// Requires: at least one point.
BoundingSphere SphereAround(const std::vector<Ecef>& points);

/// The point that stands for `points` in tests against the horizon: whoever cannot see it over the
/// ellipsoid sees none of them. In axes scaled by the ellipsoid's radii, as quantized-mesh has it
/// [RingPatrick13].
///
/// towards: the direction from the earth's centre in which the result lies. least_height_m: no
/// point is lower; below zero, the ellipsoid is shrunk by it.
/// nullopt where there is no such point: a tile as large as half the globe has none.
std::optional<Ecef> HorizonOcclusionPoint(const std::vector<Ecef>& points, const Ecef& towards,
                                          double least_height_m);

}  // namespace farhorizon

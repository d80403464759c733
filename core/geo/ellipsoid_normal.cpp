// On the ellipsoid the normal is (x, y, z / (1 - e^2)) in earth-fixed axes.
#include "core/geo/ellipsoid_normal.h"

namespace farhorizon {

Enu EllipsoidNormal(const Enu& p, const TangentFrame& frame) {
  constexpr double kOneLessE2 = 1 - 0.00669437999014;  // WGS 84
  const Ecef at = frame.ToEcef(p);
  const Enu ahead = frame.ToEnu({at.x + at.x, at.y + at.y, at.z + at.z / kOneLessE2});
  return {ahead.east - p.east, ahead.north - p.north, ahead.up - p.up};
}

}  // namespace farhorizon

#include "core/pipeline/mesh_orientation.h"

#include <algorithm>

namespace farhorizon {

namespace {

// The direction of `p` along which heights are counted, unscaled: the normal of the ellipsoid
// through p. From the surface up it is (x, y, z / (1 - e^2)); at 9 km it is off by less than 5e-6.
Enu Upwards(const Enu& p, const TangentFrame& frame) {
  constexpr double kOneLessE2 = 1 - 0.00669437999014;  // WGS 84
  const Ecef at = frame.ToEcef(p);
  const Enu ahead = frame.ToEnu({at.x + at.x, at.y + at.y, at.z + at.z / kOneLessE2});
  return {ahead.east - p.east, ahead.north - p.north, ahead.up - p.up};
}

}  // namespace

bool AllTurnLeft(const LocalMesh& mesh, const TangentFrame& frame) {
  return std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& t) {
    const Enu& a = mesh.positions[t[0]];
    const std::array<double, 3> normal = FaceNormal(a, mesh.positions[t[1]], mesh.positions[t[2]]);
    const Enu up = Upwards(a, frame);
    return normal[0] * up.east + normal[1] * up.north + normal[2] * up.up > 0;
  });
}

}  // namespace farhorizon

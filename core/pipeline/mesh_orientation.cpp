#include "core/pipeline/mesh_orientation.h"

#include <algorithm>

#include "core/geo/ellipsoid_normal.h"

namespace farhorizon {

bool AllTurnLeft(const LocalMesh& mesh, const TangentFrame& frame) {
  return std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& t) {
    const Enu& a = mesh.positions[t[0]];
    const std::array<double, 3> normal = FaceNormal(a, mesh.positions[t[1]], mesh.positions[t[2]]);
    const Enu up = EllipsoidNormal(a, frame);
    return normal[0] * up.east + normal[1] * up.north + normal[2] * up.up > 0;
  });
}

}  // namespace farhorizon

#pragma once

#include "core/geo/frames.h"
#include "core/io/local_mesh.h"

namespace farhorizon {

/// Whether every triangle runs counter-clockwise seen from above it, and none is flat. Above is
/// along the ellipsoid's normal: not the frame's up where a DEM is large and steep, and not away
/// from the Earth's centre where it is steep.
bool AllTurnLeft(const LocalMesh& mesh, const TangentFrame& frame);

}  // namespace farhorizon

#pragma once

#include "core/measure/mesh_error.h"

namespace farhorizon {

/// |height of the DEM - height of the mesh| over the posts of the terrain, metres.
///
/// A post that is in no triangle, because vertices have moved inwards, is compared with the height
/// of the outline at the point nearest to it. In doubles.
/// Requires: no triangle is flipped in plan.
/// Cost: O(posts + triangles), and the outline's edges for each post outside.
ErrorMeasure VerticalError(const Terrain& terrain, const GridMesh& mesh);

}  // namespace farhorizon

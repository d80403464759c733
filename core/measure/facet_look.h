#pragma once

#include "core/measure/mesh_error.h"

namespace farhorizon {

/// How a mesh looks when lit, as MeshError::facet_angle_rms_deg and needle_share have it.
struct FacetLook {
  double angle_rms_deg = 0;
  double needle_share = 0;
};

/// The planes are compared at the middles of the DEM's triangles. Cost: O(posts + triangles).
FacetLook MeasureFacets(const Terrain& terrain, const GridMesh& mesh, const PostPlaces& places);

}  // namespace farhorizon

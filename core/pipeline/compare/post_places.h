#pragma once

#include "core/base/result.h"
#include "core/measure/mesh_error.h"
#include "core/pipeline/compare/covered_part.h"
#include "core/pipeline/compare/mesh_frame.h"
#include "core/pipeline/terrain_input.h"

namespace farhorizon {

/// The posts of a DEM, or of a part of it, in the frame in which a mesh of `frame` is straight.
/// Errors: those of Georeference::ToEnu. Cost: O(posts).
Result<PostPlaces> PlacesFor(MeshFrame frame, const TerrainInput& input, const CoveredPart* part);

}  // namespace farhorizon

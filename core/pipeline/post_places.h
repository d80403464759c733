#pragma once

#include "core/base/result.h"
#include "core/measure/mesh_error.h"
#include "core/pipeline/georeference.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// Where the terrain's posts are in the local frame, in which decoded levels are straight, and
/// where the ellipsoid's normal points there.
///
/// Errors: those of Georeference::ToGeodetic and ToEnu. Cost: O(posts); 24 bytes a post.
Result<PostPlaces> FindPostPlaces(const Terrain& terrain, const Georeference& georeference);

}  // namespace farhorizon

#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/horizon/horizon.h"
#include "core/io/compare_svg.h"
#include "core/pipeline/terrain_input.h"
#include "core/terrain/mesh.h"
#include "core/terrain/terrain.h"

namespace farhorizon {

/// Skylines of a DEM and a mesh over its grid, in four directions at right angles and between, for
/// viewers far away. terrain, horizon, mesh: of the part that was measured.
/// Errors: those of Georeference::StepsAt. Cost: O(edges), 1200 lines a direction.
Result<std::vector<SkylinePair>> SkylinePairs(const TerrainInput& input, const Terrain& terrain,
                                              const Horizon& horizon, const GridMesh& mesh);

/// A map of errors at the posts of `dem`, of no more than 180 columns and rows: of the posts that
/// fall together, that with the greatest error counts. errors_m: a value a post, NaN for none.
ErrorMap MapOf(const std::vector<double>& errors_m, const Dem& dem, double aspect);

}  // namespace farhorizon

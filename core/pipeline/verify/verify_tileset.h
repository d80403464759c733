#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include "core/pipeline/level_tree.h"
#include "core/pipeline/report.h"
#include "core/pipeline/terrain_input.h"
#include "core/pipeline/verify/claims.h"

namespace farhorizon {

/// Whether a transform, column-major, takes the DEM's local frame to where it is.
bool PlacesFrame(const std::array<double, 16>& transform, const TerrainInput& input);

/// Checks that tileset.json has the GLBs of all levels, each once, below the one whose ground they
/// refine, with the measured errors and regions that hold them. Checks nothing where the report has
/// no GLB. contents: the GLBs as they were read, a level each.
void VerifyTileset(const TerrainInput& input, const std::filesystem::path& directory,
                   const std::vector<LevelReport>& levels,
                   const std::vector<std::vector<TileContentRegion>>& contents, Claims& claims);

}  // namespace farhorizon

#pragma once

#include <filesystem>
#include <vector>

#include "core/pipeline/terrain_tiles/terrain_tiles.h"
#include "core/pipeline/verify/claims.h"

namespace farhorizon {

/// Whether a folder has terrain tiles to be checked.
bool HasTerrain(const std::filesystem::path& directory);

/// Checks that the terrain tiles of a folder, and their layer.json, are its levels, cut again: byte
/// by byte, once they are unpacked. levels: as their GLBs have them, the finest first; fewer than
/// `count` where some could not be read.
void VerifyTerrain(const std::filesystem::path& directory, std::vector<TiledLevel> levels,
                   std::size_t count, Claims& claims);

}  // namespace farhorizon

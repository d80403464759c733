#pragma once

#include <filesystem>
#include <vector>

#include "core/pipeline/level_artifact.h"
#include "core/pipeline/verify/claims.h"
#include "core/terrain/mesh.h"

namespace farhorizon {

/// Checks what the report says of one level against its files, decoded again, and the frame that the
/// tileset places them in. Returns the level's edges by post, rising; empty where neither file decodes.
std::vector<Edge> VerifyLevel(const LevelContext& context, const std::filesystem::path& directory,
                              const LevelReport& claimed, Claims& claims);

}  // namespace farhorizon

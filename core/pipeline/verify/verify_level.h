#pragma once

#include <filesystem>
#include <vector>

#include "core/pipeline/level_artifact.h"
#include "core/pipeline/verify/claims.h"
#include "core/terrain/mesh.h"

namespace farhorizon {

/// Checks what the report says of one level against the level's files, decoded again. Returns the
/// level's edges by post, rising; empty where no file decodes.
std::vector<Edge> VerifyLevel(const LevelContext& context, const std::filesystem::path& directory,
                              const LevelReport& claimed, Claims& claims);

}  // namespace farhorizon

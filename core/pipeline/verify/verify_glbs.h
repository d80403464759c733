#pragma once

#include <filesystem>
#include <optional>

#include "core/pipeline/level_artifact.h"
#include "core/pipeline/verify/claims.h"
#include "core/pipeline/verify/verify_level_edges.h"

namespace farhorizon {

/// The level that the GLBs of a folder hold, its parts joined, with posts: each GLB is checked
/// against its own Draco streams, its skirt against its rim. nullopt where one cannot be read.
std::optional<StoredLevel> LoadGlbs(const LevelContext& context,
                                    const std::filesystem::path& directory,
                                    const LevelReport& claimed, Claims& claims);

}  // namespace farhorizon

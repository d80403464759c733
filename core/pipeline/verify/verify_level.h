#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "core/pipeline/level_artifact.h"
#include "core/pipeline/verify/claims.h"
#include "core/pipeline/verify/verify_level_edges.h"
#include "core/terrain/mesh.h"

namespace farhorizon {

/// Checks what the report says of one level against the level's files, decoded again. Returns the
/// level as they have it; nullopt where no file decodes, or its mesh cannot be measured.
std::optional<StoredLevel> VerifyLevel(const LevelContext& context,
                                       const std::filesystem::path& directory,
                                       const LevelReport& claimed, Claims& claims);

/// The edges of a decoded mesh by post, rising.
std::vector<Edge> EdgesByPost(const LocalMesh& mesh);

}  // namespace farhorizon

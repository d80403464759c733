#pragma once

#include <filesystem>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/horizon/find_horizon.h"
#include "core/pipeline/build.h"

namespace farhorizon {

/// Only the horizon edges of `dem`, in the format that the ending of `out` names: ".geojson", ".fgb" or
/// ".gpkg".
/// engine: which algorithm finds them; the file is the same but for witnesses, each good by itself.
/// Errors: kInvalidArgument for another ending; those of reading, placing and sweeping the DEM.
Status WriteHorizonEdges(const std::filesystem::path& dem, const std::filesystem::path& out,
                         const BuildOptions& options, const Watch& watch,
                         Engine engine = Engine::kAdaptive);

}  // namespace farhorizon

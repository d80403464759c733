#pragma once

#include <filesystem>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/pipeline/build_options.h"

namespace farhorizon {

/// DEM in, artifacts out: reads `dem`, finds its horizon, builds and encodes the levels, measures
/// them on what was encoded, and leaves tileset.json, lodN.glb, lodN.drc, horizon.geojson,
/// report.json and manifest.json in `directory` (made if missing). Nothing is left behind on
/// failure. Same input and options, same bytes.
Status BuildArtifacts(const std::filesystem::path& dem, const std::filesystem::path& directory,
                      const BuildOptions& options, const Watch& watch);

}  // namespace farhorizon

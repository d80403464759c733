#pragma once

#include <filesystem>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/horizon/find_horizon.h"
#include "core/pipeline/build_options.h"

namespace farhorizon {

/// Writes the horizon edges of `dem`, and no levels, in the format that the ending of `out` names:
/// ".geojson", ".fgb" or ".gpkg".
///
/// engine: the algorithm that finds the edges; the files differ in witnesses alone, all of which
///   are true.
/// Errors: kInvalidArgument for another ending; those of TerrainInput::Open, FindHorizon,
///   BuildFeatures and of writing the file.
Status WriteHorizonEdges(const std::filesystem::path& dem, const std::filesystem::path& out,
                         const BuildOptions& options, const RunControl& control,
                         Engine engine = Engine::kAdaptive);

}  // namespace farhorizon

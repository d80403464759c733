#pragma once

#include <filesystem>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/horizon/find_horizon.h"
#include "core/pipeline/build_options.h"
#include "core/pipeline/edge_measures.h"

namespace farhorizon {

/// How the horizon edges of a DEM are found and what is said of them.
struct HorizonFileOptions {
  BuildOptions build = {};  ///< those of levels and artifacts do not matter
  /// The algorithm that finds the edges; files differ in witnesses alone, all of which are true.
  Engine engine = Engine::kAdaptive;
  Weights weights = Weights::kFull;  ///< others are left out of the file
};

/// Writes the horizon edges of `dem`, and no levels, in the format that the ending of `out` names:
/// ".geojson", ".fgb" or ".gpkg".
///
/// Errors: kInvalidArgument for another ending; those of TerrainInput::Open, FindHorizon,
///   BuildFeatures and of writing the file.
Status WriteHorizonEdges(const std::filesystem::path& dem, const std::filesystem::path& out,
                         const HorizonFileOptions& options, const RunControl& control);

}  // namespace farhorizon

#pragma once

#include <filesystem>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/pipeline/build_options.h"

namespace farhorizon {

/// DEM in, artifacts out: reads `dem`, finds its horizon, builds and encodes the levels, measures
/// the encoded levels, and leaves tileset.json, lodN.glb, lodN.drc, horizon.geojson, report.json,
/// report.html and manifest.json in `directory` (made if missing), as far as options.formats asks
/// for them.
/// With "flatgeobuf" among the formats there is horizon.fgb, too, with "geopackage" horizon.gpkg,
/// with "quantized-mesh" layer.json and the tiles that it lists.
///
/// Same input and options, same bytes, except that report.html has the times of control.timings
/// where there are any. Nothing is left behind on failure.
/// Errors: those of CheckOptions, TerrainInput::Open, PlanLevels, FindHorizon and BuildLodChain; of
///   CheckOffPoles, PlaceOnGlobe and WriteTerrainTiles where their tiles are asked for; kCancelled;
///   kIo and kResourceExhausted where a file cannot be written.
Status BuildArtifacts(const std::filesystem::path& dem, const std::filesystem::path& directory,
                      const BuildOptions& options, const RunControl& control);

}  // namespace farhorizon

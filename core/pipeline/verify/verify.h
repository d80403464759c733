#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "core/pipeline/build_options.h"

namespace farhorizon {

/// One claim of the artifacts, checked. claim: what was claimed and what was found, on one line.
struct ClaimCheck {
  bool holds = false;
  std::string claim;
};

/// Measures every claim that `directory` makes about `dem` again, from the files alone: hashes,
/// counts, the set of horizon edges, their witnesses, azimuths, spans and weights, the errors of
/// each level on its decoded mesh, the tileset.
///
/// options: crs, vertical_datum and nodata as the build had them; threads.
/// Errors: those of TerrainInput::Open, FindHorizon and MeasureEdges; kNotFound, kIo and
///   kUnsupportedData where manifest, report or horizon.geojson cannot be read. A claim that does
///   not hold is no error.
Result<std::vector<ClaimCheck>> VerifyArtifacts(const std::filesystem::path& dem,
                                                const std::filesystem::path& directory,
                                                const BuildOptions& options,
                                                const RunControl& control);

}  // namespace farhorizon

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/pipeline/build.h"

namespace farhorizon {

/// One claim of the artifacts, measured again.
struct ClaimCheck {
  bool holds = false;
  std::string claim;  ///< what was claimed and what was found, on one line
};

/// Measures every claim that `directory` makes about `dem` again, from the files alone: hashes, counts,
/// the set of horizon edges, each witness, azimuths, spans and weights, both errors of each level on its decoded mesh, the tileset.
/// options: crs, vertical_datum and nodata as they were given to the build; threads.
/// Errors: where a file is missing or cannot be read at all.
Result<std::vector<ClaimCheck>> VerifyArtifacts(const std::filesystem::path& dem,
                                                const std::filesystem::path& directory,
                                                const BuildOptions& options, const Watch& watch);

}  // namespace farhorizon

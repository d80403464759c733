#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"

namespace farhorizon {

/// What `farhorizon build` and a job are asked for; the defaults are the contract's.
struct BuildOptions {
  int levels = 5;
  std::optional<double> max_error_m;  ///< unset: an eighth of the cell size
  double silhouette_error_m = 0;
  std::vector<std::string> formats = {"3dtiles", "drc", "geojson"};
  std::optional<std::string> crs;
  std::optional<std::string> vertical_datum;
  std::optional<double> nodata;
  std::int64_t max_posts = 64'000'000;
  std::optional<std::int64_t>
      work_budget;           ///< decisions about candidates; unset: by the terrain's size
  bool approximate = false;  ///< past the budget: a superset of the horizon, marked, not an error
  int threads = 1;           ///< never changes a byte of the result
};

/// DEM in, artifacts out: reads `dem`, finds its horizon, builds and encodes the levels, measures
/// them on what was encoded, and leaves tileset.json, lodN.glb, lodN.drc, horizon.geojson,
/// report.json and manifest.json in `directory` (made if missing). Nothing is left behind on
/// failure. Same input and options, same bytes.
Status BuildArtifacts(const std::filesystem::path& dem, const std::filesystem::path& directory,
                      const BuildOptions& options, const Watch& watch);

/// Checks options by themselves. Errors: kInvalidArgument, naming the option, its value and its
/// range.
Status CheckOptions(const BuildOptions& options);

/// Reads options from a job's parameters: flat names as in interface.md ("maxError"), values as
/// text. Errors: kInvalidArgument, kind "unknown-parameter" or "invalid-parameter".
Result<BuildOptions> ParseOptions(const std::map<std::string, std::string>& parameters);

}  // namespace farhorizon

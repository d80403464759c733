#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/horizon/find_horizon.h"

namespace farhorizon {

/// Options of `farhorizon build` and of a job. The defaults are those of proto/openapi.yaml.
struct BuildOptions {
  int levels = 5;
  std::optional<double> max_error_m;  ///< of level 0; unset: an eighth of the cell size
  double silhouette_error_m = 0;      ///< of level 0
  std::vector<std::string> formats = {"3dtiles", "drc", "geojson"};
  std::optional<std::string> crs;
  std::optional<std::string> vertical_datum;
  std::optional<std::string> height_unit;      ///< "m", "ft" or "us-ft"
  std::optional<std::string> datum_operation;  ///< as GlobeTransform has it
  std::vector<double> nodata;                  ///< beside the file's own
  std::int64_t max_posts = 64'000'000;
  /// As HorizonOptions has it: decisions about candidates.
  std::optional<std::int64_t> work_budget;
  bool approximate = false;  ///< as HorizonOptions has it
  int threads = 1;           ///< never changes a byte of the result
};

/// Checks options that need no DEM to be checked. Errors: kInvalidArgument, naming the option, its
/// value and its range.
Status CheckOptions(const BuildOptions& options);

/// Reads options from a job's parameters and checks them: flat names as in proto/openapi.yaml
/// ("maxError"), values as text. Errors: kInvalidArgument, kind "unknown-parameter" or
/// "invalid-parameter"; those of CheckOptions.
Result<BuildOptions> ParseOptions(const std::map<std::string, std::string>& parameters);

/// The options of FindHorizon for a build.
HorizonOptions HorizonOptionsOf(const BuildOptions& options);

}  // namespace farhorizon

#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace farhorizon {

/// What `farhorizon build` and a job are asked for; the defaults are the contract's.
struct BuildOptions {
  int levels = 5;
  std::optional<double> max_error_m;  ///< unset: an eighth of the cell size
  double silhouette_error_m = 0;
  std::vector<std::string> formats = {"3dtiles", "drc", "geojson"};
  double skirt_m = 0;
  std::optional<std::string> crs;
  std::optional<std::string> vertical_datum;
  std::optional<double> nodata;
  std::int64_t max_posts = 64'000'000;
  std::optional<std::int64_t>
      work_budget;           ///< decisions about candidates; unset: by the terrain's size
  bool approximate = false;  ///< past the budget: a superset of the horizon, marked, not an error
  int threads = 1;           ///< never changes a byte of the result
};

/// Checks options by themselves. Errors: kInvalidArgument, naming the option, its value and its
/// range.
Status CheckOptions(const BuildOptions& options);

/// Reads options from a job's parameters: flat names as in interface.md ("maxError"), values as
/// text. Errors: kInvalidArgument, kind "unknown-parameter" or "invalid-parameter".
Result<BuildOptions> ParseOptions(const std::map<std::string, std::string>& parameters);

}  // namespace farhorizon

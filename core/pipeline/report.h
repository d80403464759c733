#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/horizon/horizon.h"
#include "core/simplify/mesh_error.h"

namespace farhorizon {

/// What was read: the `dem` member of report.json.
struct DemReport {
  std::int32_t columns = 0;
  std::int32_t rows = 0;
  std::string crs;
  std::array<double, 2> cell_m = {0, 0};
  std::array<double, 2> heights_m = {0, 0};
  std::int64_t nodata_posts = 0;
  double height_quantum_m = 1;
  bool heights_rounded = false;  ///< to that quantum; else they are as stored
  std::string sha256;
};

/// What one level was asked for, and measured as, on the decoded mesh: a member of `levels`.
struct LevelReport {
  int level = 0;
  std::int64_t triangles = 0;
  std::int64_t vertices = 0;
  std::int64_t horizon_edges = 0;
  double asked_vertical_m = 0;    ///< what the level was allowed
  double asked_silhouette_m = 0;  ///< and where the search for the certified bound began
  ErrorMeasure vertical;
  ErrorMeasure silhouette;
  double geometric_error_m = 0;
  double quantization_step_m = 0;
  std::int64_t glb_bytes = 0;
  std::int64_t drc_bytes = 0;
};

/// report.json.
struct Report {
  std::string version;
  DemReport dem;
  std::int64_t horizon_edges = 0;
  HorizonStatistics statistics;
  std::vector<LevelReport> levels;
};

std::string WriteReport(const Report& report);
/// Errors: kUnsupportedData, naming the member that is missing or wrong.
Result<Report> ReadReport(const std::string& text);

/// `value` with its last places rounded up, so that a bound stays one: to a millionth of a metre.
double RoundUp(double value);

}  // namespace farhorizon

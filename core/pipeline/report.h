#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/assumption.h"
#include "core/base/result.h"
#include "core/horizon/horizon.h"
#include "core/measure/mesh_error.h"

namespace farhorizon {

/// The DEM that was read: the `dem` member of report.json. heights_m: the least and the greatest.
struct DemReport {
  std::int32_t columns = 0;
  std::int32_t rows = 0;
  std::string crs;
  std::array<double, 2> cell_m = {0, 0};
  std::array<double, 2> heights_m = {0, 0};
  std::int64_t nodata_posts = 0;
  double height_quantum_m = 1;
  bool heights_rounded = false;  ///< true: to that quantum; false: heights are as stored
  std::string sha256;
};

/// What a level was asked for: at most so many triangles, or, where `triangles` is 0, to be off by
/// no more than vertical_m at a post and silhouette_m at a line.
struct LevelAsked {
  std::int64_t triangles = 0;
  double vertical_m = 0;
  double silhouette_m = 0;
};

/// The edges of a level that are drawn as its horizon; all 0 where no file has them.
///
/// edges: the DEM's horizon edges that the level has, and the others that have the level's own
/// skyline on them. carrying: how many of them a sampled line of sight has shown to have it on
/// them. share: of the level's own skyline, in the measure of lines, on one of the edges: an
/// estimate. bytes: of lodN-horizon.glb.
struct SkylineEdgesReport {
  std::int64_t edges = 0;
  std::int64_t carrying = 0;
  double share = 0;
  std::int64_t bytes = 0;
};

/// One level, measured on its decoded mesh: a member of `levels` of report.json.
///
/// exact: before vertices were rounded to be encoded, its skyline was the DEM's. vertical,
/// silhouette, rim_m, facet_angle_deg (root mean square), needle_share: as MeshError has them.
/// quantization_step_m, side_step_m: positions are multiples of the former, those on the tile's
/// four sides of the latter. skirt_m, skirt_triangles: how deep the skirt in the GLB is, and its
/// triangles, which `triangles` leaves out; 0 where there is none. glb_bytes, drc_bytes: 0 where
/// there is no such file.
struct LevelReport {
  int level = 0;
  bool exact = false;
  std::int64_t triangles = 0;
  std::int64_t vertices = 0;
  std::int64_t horizon_edges = 0;
  LevelAsked asked;
  ErrorMeasure vertical;
  ErrorMeasure silhouette;
  double rim_m = 0;
  double facet_angle_deg = 0;
  double needle_share = 0;
  double geometric_error_m = 0;
  double quantization_step_m = 0;
  double side_step_m = 0;
  double skirt_m = 0;
  std::int64_t skirt_triangles = 0;
  std::int64_t glb_bytes = 0;
  std::int64_t drc_bytes = 0;
  SkylineEdgesReport skyline_edges;
};

/// The contents of report.json.
struct Report {
  std::string version;
  DemReport dem;
  Assumptions assumptions;
  std::int64_t horizon_edges = 0;
  HorizonStatistics statistics;
  std::vector<LevelReport> levels;
};

/// The text of report.json.
std::string WriteReport(const Report& report);
/// Reads back the text of WriteReport. Errors: kUnsupportedData, kind "bad-report", with the member
/// that is missing or wrong.
Result<Report> ReadReport(const std::string& text);

/// `value`, metres, rounded up to a millionth: a bound stays a bound.
double RoundUp(double value);

}  // namespace farhorizon

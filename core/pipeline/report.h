#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/assumption.h"
#include "core/base/result.h"
#include "core/geo/frame_choice.h"
#include "core/horizon/horizon.h"
#include "core/measure/mesh_error.h"
#include "core/terrain/part_grid.h"

namespace farhorizon {

/// The DEM that was read: the `dem` member of report.json, without its apron but for the SHA-256.
/// heights_m: the least and the greatest. apron: rows and columns on each side that were left out.
struct DemReport {
  std::int32_t columns = 0;
  std::int32_t rows = 0;
  std::string crs;
  std::array<double, 2> cell_m = {0, 0};
  std::array<double, 2> heights_m = {0, 0};
  int apron = 0;
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
/// four sides of the latter. seam_reach: as MeanNormals has it, 0 without an apron. skirt_m,
/// skirt_triangles: how deep the skirt in the GLB is, and its triangles, which `triangles` leaves
/// out; 0 where there is none. parts: into how many the GLB is cut; glb_bytes is their sum, as
/// skirt_triangles is. glb_bytes, drc_bytes: 0 where there is no such file.
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
  int seam_reach = 0;
  double skirt_m = 0;
  std::int64_t skirt_triangles = 0;
  PartDepth parts;
  std::int64_t glb_bytes = 0;
  std::int64_t drc_bytes = 0;
  SkylineEdgesReport skyline_edges;
};

/// The local frame: the `frame` member of report.json. transform: from the frame to ECEF,
/// column-major, as the tileset's.
struct FrameReport {
  FrameChoice axes;
  std::array<double, 16> transform = {};
};

/// The contents of report.json.
struct Report {
  std::string version;
  DemReport dem;
  Assumptions assumptions;
  std::int64_t horizon_edges = 0;
  std::optional<std::int64_t> edges_in_context;  ///< as FindInContext has it; nullopt: not asked
  HorizonStatistics statistics;
  std::vector<LevelReport> levels;
  std::optional<FrameReport> frame;  ///< nullopt: of a version that knew the tile's own alone
};

/// The text of report.json.
std::string WriteReport(const Report& report);
/// Reads back the text of WriteReport. Errors: kUnsupportedData, kind "bad-report", with the member
/// that is missing or wrong.
Result<Report> ReadReport(const std::string& text);

/// `value`, metres, rounded up to a millionth: a bound stays a bound.
double RoundUp(double value);

}  // namespace farhorizon

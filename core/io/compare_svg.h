#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace farhorizon {

/// Two skylines of one direction, from left to right.
///
/// offsets_m: to the right of the line of sight through the middle, at regular distances. dem_m,
/// mesh_m: the greatest height over the line there; NaN where it misses the surface.
struct SkylinePair {
  double azimuth_deg = 0;
  std::vector<double> offsets_m;
  std::vector<double> dem_m;
  std::vector<double> mesh_m;
};

/// A map of errors, row by row, the first row above. errors_m: of mesh less DEM; NaN where there is
/// nothing to compare. aspect: how wide a column is beside a row.
struct ErrorMap {
  std::int32_t columns = 0;
  std::int32_t rows = 0;
  std::vector<double> errors_m;
  double aspect = 1;
};

/// What a comparison looks like. lines: of text below the title.
struct ComparisonPicture {
  std::string title;
  std::vector<std::string> lines;
  std::vector<SkylinePair> skylines;
  ErrorMap map;
};

/// Draws the picture as SVG: each pair of skylines with their difference enlarged below, then the
/// map with its scale. Same picture, same bytes.
std::string DrawComparisonSvg(const ComparisonPicture& picture);

}  // namespace farhorizon

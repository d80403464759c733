// What values options may have, whoever asks for them; build_parameters.cpp reads them.
#include "core/pipeline/build_options.h"

#include <algorithm>
#include <array>
#include <sstream>

#include "core/geo/crs_text.h"
#include "core/pipeline/given_parameter.h"

namespace farhorizon {

namespace {

using Given = GivenParameter;

constexpr int kMostLevels = 12;
// Far wider than the ground that lights a side (SeamReach).
constexpr int kMostApron = 1000;
// A triangulation has two triangles or more; no raster that is read has more than this.
constexpr std::int64_t kFewestTriangles = 2;
constexpr std::int64_t kMostTriangles = 1'000'000'000;
// Smaller tiles are less than their headers are worth.
constexpr std::int64_t kFewestTileTriangles = 1000;

std::string Text(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

// Requires: `triangles` do not rise.
Status CheckTriangles(const std::vector<std::int64_t>& triangles) {
  std::string text;
  for (const std::int64_t count : triangles) {
    text.append(text.empty() ? "" : ",").append(std::to_string(count));
  }
  const Given given{"triangles", text};
  if (triangles.size() > static_cast<std::size_t>(kMostLevels)) {
    return given.Expected("at most " + std::to_string(kMostLevels) + " levels");
  }
  const bool within = std::ranges::all_of(triangles, [](std::int64_t count) {
    return count >= kFewestTriangles && count <= kMostTriangles;
  });
  if (!within) return given.Expected("numbers from 2 to 1000000000");
  if (std::ranges::adjacent_find(triangles) != triangles.end()) {
    return given.Expected("a number for each level, no two alike");
  }
  return Ok{};
}

}  // namespace

bool Asks(const BuildOptions& options, std::string_view format) {
  return std::ranges::find(options.formats, format) != options.formats.end();
}

Status CheckOptions(const BuildOptions& options) {
  if (options.levels < 1 || options.levels > kMostLevels) {
    return Given{"levels", std::to_string(options.levels)}.Expected("1 to 12");
  }
  if (options.max_error_m && !(*options.max_error_m > 0 && *options.max_error_m <= 1e5)) {
    return Given{"maxError", Text(*options.max_error_m)}.Expected(
        "more than 0, at most 100000 metres");
  }
  if (!(options.silhouette_error_m >= 0 && options.silhouette_error_m <= 1e5)) {
    return Given{"silhouetteError", Text(options.silhouette_error_m)}.Expected(
        "0 to 100000 metres");
  }
  if (Status triangles = CheckTriangles(options.triangles); !triangles) return triangles;
  if (options.work_budget && *options.work_budget < 1) {
    return Given{"workBudget", std::to_string(*options.work_budget)}.Expected("1 or more");
  }
  // An empty text is an error of the DEM, which may have a system of its own.
  if (options.crs && !options.crs->empty()) {
    if (Status safe = CheckCrsText(CompletedCrsText(*options.crs)); !safe) return safe;
  }
  if (options.vertical_datum && !options.vertical_datum->empty()) {
    const std::string text = CompletedCrsText(*options.vertical_datum);
    if (Status safe = CheckCrsText(text, CrsRole::kHeights); !safe) return safe;
  }
  const std::string unit = options.height_unit.value_or("m");
  if (unit != "m" && unit != "ft" && unit != "us-ft") {
    return Given{"heightUnit", unit}.Expected("m, ft or us-ft");
  }
  if (options.skirt_m && !(*options.skirt_m >= 0 && *options.skirt_m <= 1e5)) {
    return Given{"skirt", Text(*options.skirt_m)}.Expected("auto, or 0 to 100000 metres");
  }
  if (options.apron < 0 || options.apron > kMostApron) {
    return Given{"apron", std::to_string(options.apron)}.Expected("0 to 1000");
  }
  if (options.horizon_context && options.apron == 0) {
    return Given{"horizonContext", "true"}.Expected(
        "false where --apron is 0: there is no ground around the tile; give --apron N too");
  }
  const std::int64_t tile = options.tile_triangles;
  if (tile != 0 && (tile < kFewestTileTriangles || tile > kMostTriangles)) {
    return Given{"tileTriangles", std::to_string(tile)}.Expected("0, or 1000 to 1000000000");
  }
  if (options.formats.empty()) return Given{"formats", ""}.Expected("at least one format");
  constexpr std::array kKnown = {"3dtiles",    "drc",        "geojson",
                                 "flatgeobuf", "geopackage", "quantized-mesh"};
  for (const std::string& format : options.formats) {
    if (std::find(kKnown.begin(), kKnown.end(), format) == kKnown.end()) {
      return Given{"formats", format}.Expected(
          "of 3dtiles, drc, geojson, flatgeobuf, geopackage and quantized-mesh");
    }
  }
  if (options.threads < 1 || options.threads > 1024) {
    return Given{"threads", std::to_string(options.threads)}.Expected("1 to 1024");
  }
  return Ok{};
}

HorizonOptions HorizonOptionsOf(const BuildOptions& options) {
  return {.threads = options.threads,
          .work_budget = options.work_budget,
          .approximate = options.approximate,
          .budget_share = 0.5};
}

}  // namespace farhorizon

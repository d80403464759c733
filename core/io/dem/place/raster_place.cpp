// Where a raster's cells lie: the geotransform and the reference system that the file states, or
// the files beside it that GIS programs write for formats without a place of their own.
#include "core/io/dem/place/raster_place.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include <gdal.h>
#include <ogr_srs_api.h>

#include "core/io/dem/band_values.h"
#include "core/io/dem/place/prj_file.h"
#include "core/io/dem/place/reference_system.h"
#include "core/io/dem/place/world_file.h"

namespace farhorizon {

namespace {

// GDAL's: x = c[0] + c[1] * P + c[2] * L and y = c[3] + c[4] * P + c[5] * L, at column P and row L
// of the raster, counted from the corner of its first cell.
using Coefficients = std::array<double, 6>;

// The share of a cell by which a post may be off. Cells are said to a millimetre for steps of a
// metre at best; the encoded mesh rounds positions by far more.
constexpr double kMostOff = 1e-3;

// Bilinear: the nearest cell's height moves posts by half a cell. Cells that the warped raster has
// and this one has not get a value that is no height; without -dstnodata they are ground at zero.
constexpr const char* kWarp =
    "gdalwarp -r bilinear -ot Float32 -dstnodata -9999 IN OUT.tif (with -srcnodata V before IN "
    "where a value V that no tag names means no data: it would be blended with the ground)";

constexpr const char* kStateCorners =
    "if you know its corners, state them with gdal_translate -a_ullr WEST NORTH EAST SOUTH";

Error BadData(const std::string& message, ErrorKind kind) {
  return {ErrorCode::kUnsupportedData, message, kind};
}

Error Degenerate(const std::string& whose) {
  return BadData(whose + " is degenerate (cell size zero or not a number); " + kStateCorners,
                 "degenerate-geotransform");
}

// The grid along the axes that goes through the middle of the grid of `c`. There the distance is
// zero and it grows evenly to the sides, so that it is greatest at the corners:
//   |c[2]| * (rows - 1) / 2 along x, |c[4]| * (columns - 1) / 2 along y.
// whose: what the coefficients are of, for messages.
Result<GeoTransform> AlongTheAxes(const Coefficients& c, int columns, int rows,
                                  const std::string& whose) {
  if (!std::ranges::all_of(c, [](double x) { return std::isfinite(x); })) return Degenerate(whose);
  const double off_x = std::abs(c[2]) * (rows - 1) / 2;
  const double off_y = std::abs(c[4]) * (columns - 1) / 2;
  if (off_x > kMostOff * std::abs(c[1]) || off_y > kMostOff * std::abs(c[5])) {
    return BadData(whose + " is rotated or sheared; make it north up with " + kWarp,
                   "rotated-geotransform");
  }
  // Posts are the centres of cells, for PixelIsPoint files too: GDAL shifts their coefficients.
  const GeoTransform transform = {c[0] + 0.5 * c[1] + 0.5 * rows * c[2],
                                  c[3] + 0.5 * c[5] + 0.5 * columns * c[4], c[1], c[5]};
  const double last_x = transform.origin_x + (columns - 1) * c[1];
  const double last_y = transform.origin_y + (rows - 1) * c[5];
  const bool apart = transform.origin_x + c[1] != transform.origin_x && last_x - c[1] != last_x &&
                     transform.origin_y + c[5] != transform.origin_y && last_y - c[5] != last_y;
  if (!apart || !std::isfinite(last_x) || !std::isfinite(last_y)) return Degenerate(whose);
  return transform;
}

// How far, in cells, `c` misses the control point.
double Miss(const GDAL_GCP& point, const Coefficients& c) {
  const double x = c[0] + c[1] * point.dfGCPPixel + c[2] * point.dfGCPLine;
  const double y = c[3] + c[4] * point.dfGCPPixel + c[5] * point.dfGCPLine;
  return std::max(std::abs((x - point.dfGCPX) / c[1]), std::abs((y - point.dfGCPY) / c[5]));
}

Result<GeoTransform> FromControlPoints(GDALDatasetH dataset) {
  const int count = GDALGetGCPCount(dataset);
  const GDAL_GCP* points = GDALGetGCPs(dataset);
  const std::string whose = "the raster, placed by " + std::to_string(count) + " control points,";
  Coefficients c{};
  if (count < 3) {
    return BadData("the raster is placed by " + std::to_string(count) +
                       " control points (GCPs), at least 3 are needed; " + kStateCorners,
                   "degenerate-geotransform");
  }
  if (GDALGCPsToGeoTransform(count, points, c.data(), TRUE) == FALSE) return Degenerate(whose);
  if (std::all_of(points, points + count,
                  [&c](const GDAL_GCP& point) { return Miss(point, c) <= kMostOff; })) {
    return AlongTheAxes(c, GDALGetRasterXSize(dataset), GDALGetRasterYSize(dataset), whose);
  }
  return BadData(whose + " is warped; make it north up with " + kWarp, "rotated-geotransform");
}

bool SamePlace(const GeoTransform& a, const GeoTransform& b, int columns, int rows) {
  const auto near = [](double p, double q, double step) {
    return std::abs(p - q) <= kMostOff * std::abs(step);
  };
  return near(a.origin_x, b.origin_x, a.step_x) && near(a.origin_y, b.origin_y, a.step_y) &&
         near(a.step_x * columns, b.step_x * columns, a.step_x) &&
         near(a.step_y * rows, b.step_y * rows, a.step_y);
}

}  // namespace

Result<GeoTransform> ReadGeoTransform(OpenedDem& dem) {
  void* const dataset = dem.dataset;
  Assumptions& assumptions = dem.assumptions;
  const int columns = GDALGetRasterXSize(dataset);
  const int rows = GDALGetRasterYSize(dataset);
  const std::optional<WorldFile> world = FindWorldFile(dem.path);
  Coefficients own = dem.aux.geotransform.value_or(Coefficients{});
  if (dem.aux.geotransform || GDALGetGeoTransform(dataset, own.data()) == CE_None) {
    Result<GeoTransform> place = AlongTheAxes(own, columns, rows, "the raster");
    if (!place || !world || !world->geotransform) return place;
    const Result<GeoTransform> other =
        AlongTheAxes(*world->geotransform, columns, rows, world->name);
    if (!other || !SamePlace(*place, *other, columns, rows)) {
      assumptions.push_back({"world-file", world->name + " beside the raster places it elsewhere " +
                                               "than the raster itself, which was taken; move " +
                                               "away the one that is wrong"});
    }
    return place;
  }
  if (GDALGetGCPCount(dataset) > 0) return FromControlPoints(dataset);
  if (world && !world->geotransform) {
    return BadData("the raster does not say where its cells lie, and the world file " +
                       world->name + " beside it has not the six numbers of one; " + kStateCorners,
                   "degenerate-geotransform");
  }
  if (world) {
    assumptions.push_back(
        {"world-file", "the raster does not say where its cells lie; " + world->name +
                           " beside it was taken (gdal_translate IN OUT.tif puts it in)"});
    return AlongTheAxes(*world->geotransform, columns, rows, world->name);
  }
  if (GDALGetMetadata(dataset, "RPC") != nullptr) {
    return BadData(
        std::string("the raster is placed by rational polynomials (RPC), which depend on the "
                    "heights; make it north up with ") +
            "gdalwarp -rpc -r bilinear -ot Float32 -dstnodata -9999 IN OUT.tif",
        "rotated-geotransform");
  }
  return BadData(std::string("the raster does not say where its cells lie (no geotransform); put "
                             "its world file (.tfw) beside it under the same name (for a service: "
                             "there, and send what gdal_translate IN OUT.tif makes of both), or ") +
                     kStateCorners,
                 "degenerate-geotransform");
}

Result<std::string> ReadFileCrs(const OpenedDem& dem, Assumptions& assumptions) {
  if (dem.aux.crs) return *dem.aux.crs;
  void* const dataset = dem.dataset;
  OGRSpatialReferenceH crs = GDALGetSpatialRef(dataset);
  if (crs == nullptr && GDALGetGCPCount(dataset) > 0) crs = GDALGetGCPSpatialRef(dataset);
  std::optional<PrjFile> prj = FindPrjFile(dem.path);
  if (crs != nullptr) {
    if (prj) SayPassedOver(*prj, crs, assumptions);
    return NameOfCrs(crs);
  }
  if (!prj) {
    return BadData("the DEM has no reference system; name it with --crs, for example EPSG:4326",
                   "no-crs");
  }
  if (!prj->crs) {
    return BadData("the DEM has no reference system, and " + prj->name +
                       " beside it cannot be read; name it with --crs, for example EPSG:4326",
                   "no-crs");
  }
  assumptions.push_back({"prj-file", "the DEM has no reference system; " + prj->name +
                                         " beside it was taken (--crs states another)"});
  SayUnreadOf(*prj, assumptions);
  return NameOfCrs(prj->crs.get());
}

}  // namespace farhorizon

// Where a raster's cells lie, as the file says: the geotransform and the reference system.
#include "core/io/dem/raster_place.h"

#include <algorithm>
#include <cmath>

#include <cpl_conv.h>
#include <gdal.h>
#include <ogr_srs_api.h>

namespace farhorizon {

namespace {

Error BadData(const std::string& message, ErrorKind kind) {
  return {ErrorCode::kUnsupportedData, message, kind};
}

}  // namespace

Result<GeoTransform> ReadGeoTransform(void* dataset) {
  double g[6] = {0, 0, 0, 0, 0, 0};
  if (GDALGetGeoTransform(dataset, g) != CE_None) {
    return BadData(
        "the raster does not say where its cells lie (no geotransform); give it one "
        "with gdal_translate -a_ullr",
        "degenerate-geotransform");
  }
  const bool finite = std::ranges::all_of(g, [](double x) { return std::isfinite(x); });
  if (finite && (g[2] != 0 || g[4] != 0)) {
    return BadData("the raster is rotated or sheared; make it north up with gdalwarp",
                   "rotated-geotransform");
  }
  if (finite && g[1] < 0) {
    return BadData("the raster's columns run from east to west; turn it round with gdalwarp",
                   "rotated-geotransform");
  }
  // GDAL's coefficients are those of cell corners, for PixelIsPoint files too (it shifts them).
  const GeoTransform transform = {g[0] + 0.5 * g[1], g[3] + 0.5 * g[5], g[1], g[5]};
  const double last_x = transform.origin_x + (GDALGetRasterXSize(dataset) - 1) * g[1];
  const double last_y = transform.origin_y + (GDALGetRasterYSize(dataset) - 1) * g[5];
  const bool apart = transform.origin_x + g[1] != transform.origin_x && last_x - g[1] != last_x &&
                     transform.origin_y + g[5] != transform.origin_y && last_y - g[5] != last_y;
  if (!finite || !apart || !std::isfinite(last_x) || !std::isfinite(last_y)) {
    return BadData(
        "the raster's geotransform is degenerate (cell size zero or not a number); give "
        "it one with gdal_translate -a_ullr",
        "degenerate-geotransform");
  }
  return transform;
}

Result<std::string> ReadCrs(void* dataset, const std::optional<std::string>& stated) {
  if (stated) return *stated;
  const OGRSpatialReferenceH crs = GDALGetSpatialRef(dataset);
  if (crs == nullptr) {
    return BadData("the DEM has no reference system; name it with --crs, for example EPSG:4326",
                   "no-crs");
  }
  const char* authority = OSRGetAuthorityName(crs, nullptr);
  const char* code = OSRGetAuthorityCode(crs, nullptr);
  if (authority != nullptr && code != nullptr) return std::string(authority) + ":" + code;
  const char* const format[] = {"FORMAT=WKT2_2019", "MULTILINE=NO", nullptr};
  char* text = nullptr;
  const OGRErr failure = OSRExportToWktEx(crs, &text, format);
  std::string wkt = text != nullptr ? text : "";
  CPLFree(text);
  if (failure != OGRERR_NONE || wkt.empty()) {
    return BadData("the DEM's reference system cannot be read; name it with --crs", "no-crs");
  }
  return wkt;
}

}  // namespace farhorizon

// Finds out which of the formats that this program reads a file has, and opens it so that GDAL
// opens no other file.
#include "core/io/dem/open_raster.h"

#include <string>

#include <cpl_conv.h>
#include <gdal.h>

namespace farhorizon {

namespace {

std::string Quoted(const std::filesystem::path& path) {
  std::string quoted(1, '"');
  return quoted.append(path.filename().string()).append(1, '"');
}

RasterPtr OpenWith(const std::string& path, const char* const* drivers) {
  // INTERNAL: no world or .tab file; OVERVIEW_LEVEL: no OVERVIEW_FILE redirection (measured).
  const char* const options[] = {"OVERVIEW_LEVEL=NONE", "GEOREF_SOURCES=INTERNAL", nullptr};
  return RasterPtr(
      GDALOpenEx(path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, drivers, options, nullptr));
}

}  // namespace

void CloseRaster::operator()(void* dataset) const { GDALClose(dataset); }

Result<RasterPtr> OpenRaster(const std::filesystem::path& path, GdalSession& session) {
  std::error_code failure;
  if (!std::filesystem::is_regular_file(path, failure)) {
    return Error{ErrorCode::kNotFound, "there is no file " + Quoted(path), "no-such-file"};
  }
  const std::string absolute = std::filesystem::absolute(path).lexically_normal().string();
  if (absolute.starts_with("/vsi")) {
    return Error{ErrorCode::kInvalidArgument, "paths under /vsi are GDAL's, not files of ours",
                 "virtual-path"};
  }
  const char* const alone[] = {"GTiff", "AAIGrid", "SRTMHGT", "DTED", "USGSDEM", nullptr};
  RasterPtr dataset = OpenWith(absolute, alone);
  if (!dataset) {
    const std::string first = session.Complaint();
    // ENVI keeps its header in a file beside, which GDAL sees only without EMPTY_DIR.
    CPLSetThreadLocalConfigOption("GDAL_DISABLE_READDIR_ON_OPEN", "TRUE");
    const char* const envi[] = {"ENVI", nullptr};
    dataset = OpenWith(absolute, envi);
    CPLSetThreadLocalConfigOption("GDAL_DISABLE_READDIR_ON_OPEN", "EMPTY_DIR");
    if (!dataset) {
      return Error{ErrorCode::kUnsupportedData,
                   Quoted(path) + " is no raster that can be read" + first +
                       "; expected GeoTIFF, Arc/Info ASCII grid, SRTM HGT, DTED, USGS DEM or ENVI",
                   "not-a-raster"};
    }
  }
  session.Forget();
  return dataset;
}

}  // namespace farhorizon

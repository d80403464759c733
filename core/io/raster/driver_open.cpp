#include "core/io/raster/driver_open.h"

#include <gdal.h>

namespace farhorizon {

void CloseRaster::operator()(void* dataset) const { GDALClose(dataset); }

RasterPtr OpenWith(const std::string& path, const char* driver) {
  // INTERNAL: no world or .tab file; OVERVIEW_LEVEL: no OVERVIEW_FILE redirection (measured).
  const char* const options[] = {"OVERVIEW_LEVEL=NONE", "GEOREF_SOURCES=INTERNAL", nullptr};
  const char* const drivers[] = {driver, nullptr};
  return RasterPtr(
      GDALOpenEx(path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, drivers, options, nullptr));
}

}  // namespace farhorizon

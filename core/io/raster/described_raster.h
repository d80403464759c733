#pragma once

#include <filesystem>

#include "core/base/result.h"
#include "core/io/gdal_session.h"
#include "core/io/raster/driver_open.h"

namespace farhorizon {

/// Opens the numbers at `path` that a .hdr beside describes: ENVI where that begins so, or Esri's
/// (.bil, .bsq, .flt), with the reference system of the .prj beside. Null where there is no .hdr.
/// GDAL sees these two or three files alone.
/// Errors: kUnsupportedData, kinds "not-a-raster", "truncated", as CheckEsriHeader; kIo.
Result<RasterPtr> OpenDescribedRaster(const std::filesystem::path& path,
                                      const GdalSession& session);

}  // namespace farhorizon

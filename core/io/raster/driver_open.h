#pragma once

#include <memory>
#include <string>

namespace farhorizon {

/// Closes a GDALDatasetH.
struct CloseRaster {
  void operator()(void* dataset) const;
};
/// A GDALDatasetH, closed with its owner.
using RasterPtr = std::unique_ptr<void, CloseRaster>;

/// Opens the raster at `path`, a name for GDAL, with this one driver; null where it does not take
/// it. Neither world files nor overviews are looked for.
/// Requires: a GdalSession, which keeps what GDAL says.
RasterPtr OpenWith(const std::string& path, const char* driver);

}  // namespace farhorizon

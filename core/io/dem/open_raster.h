#pragma once

#include <filesystem>
#include <memory>

#include "core/base/result.h"
#include "core/io/gdal_session.h"

namespace farhorizon {

/// Closes a GDALDatasetH.
struct CloseRaster {
  void operator()(void* dataset) const;
};
/// A GDALDatasetH, closed with its owner.
using RasterPtr = std::unique_ptr<void, CloseRaster>;

/// Opens the raster at `path` with the drivers of this program.
/// Errors: kNotFound; kInvalidArgument "virtual-path"; kUnsupportedData "not-a-raster".
Result<RasterPtr> OpenRaster(const std::filesystem::path& path, GdalSession& session);

}  // namespace farhorizon

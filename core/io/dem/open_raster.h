#pragma once

#include <cstdint>
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

/// Opens the raster at `path` with the one driver that its first bytes, or its name, call for.
/// GDAL opens no other file than that, except the .hdr of a raster that needs one and the .prj of
/// an Arc/Info ASCII grid. Text grids are read whole, with at most `max_cells` cells.
/// Errors: kNotFound; kInvalidArgument "virtual-path"; kUnsupportedData "not-a-raster", which names
///   what the file is and what makes it readable, "truncated"; kResourceExhausted
///   "raster-too-large"; kIo.
Result<RasterPtr> OpenRaster(const std::filesystem::path& path, std::int64_t max_cells,
                             GdalSession& session);

}  // namespace farhorizon

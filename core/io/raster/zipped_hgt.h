#pragma once

#include <filesystem>

#include "core/base/result.h"
#include "core/io/raster/driver_open.h"

namespace farhorizon {

/// Opens the one HGT tile in the zip archive at `path`; null where GDAL's driver does not take it.
/// The archive's directory must give it a tile's size, and no more than that is inflated.
/// Errors: kUnsupportedData, kinds "not-a-raster", "truncated".
Result<RasterPtr> OpenZippedHgt(const std::filesystem::path& path);

}  // namespace farhorizon

#pragma once

#include <filesystem>
#include <string>

#include "core/base/result.h"

namespace farhorizon {

/// Error of kind "truncated": what is missing, and the remedy.
Error Truncated(const std::string& what);

/// Whether the file at `path`, opened as GDAL's `dataset` (a GDALDatasetH) of one band, holds all
/// its cells. GDAL reads those that a TIFF leaves out, that an ASCII grid has no number for, or
/// that lie beyond the end of a flat file as 0: sea level in the middle of a mountain.
///
/// Blocks that a sparse TIFF with nodata leaves out are no data, and so complete.
/// Errors: kUnsupportedData "truncated", "not-a-raster"; kIo.
Status CheckComplete(void* dataset, const std::filesystem::path& path, bool has_nodata);

}  // namespace farhorizon

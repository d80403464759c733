#pragma once

#include <filesystem>
#include <string>

#include "core/base/result.h"

namespace farhorizon {

/// The error of kind "truncated", which says what is missing and the remedy.
Error Truncated(const std::string& what);

/// Checks that the file at `path`, opened as GDAL's `dataset` (a GDALDatasetH) of one band, holds
/// all its cells. GDAL reads as 0 the cells that a TIFF leaves out, or that lie beyond the end of a
/// flat file: sea level in the middle of a mountain. Text grids are complete where they were read.
///
/// Blocks that a sparse TIFF with nodata leaves out are no data; such a file is complete.
/// Errors: kUnsupportedData, kind "truncated" or "not-a-raster"; kIo.
Status CheckComplete(void* dataset, const std::filesystem::path& path, bool has_nodata);

}  // namespace farhorizon

#pragma once

#include <filesystem>
#include <string>

#include "core/base/result.h"

namespace farhorizon {

/// The error of kind "truncated", which says what is missing and the remedy.
Error Truncated(const std::string& what);

/// Checks that the file at `path`, opened as GDAL's `dataset` (a GDALDatasetH), holds all its cells.
/// GDAL reads as 0 the cells that an ASCII grid has no number for, or that lie beyond the end of a
/// flat file: sea level in the middle of a mountain. TIFFs: FindAbsentBlocks.
/// Errors: kUnsupportedData, kind "truncated" or "not-a-raster"; kIo.
Status CheckComplete(void* dataset, const std::filesystem::path& path);

}  // namespace farhorizon

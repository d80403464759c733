#pragma once

#include <filesystem>
#include <string>

#include "core/base/result.h"

namespace farhorizon {

/// The error of kind "truncated", which says what is missing and the remedy.
Error Truncated(const std::string& what);

/// Checks that the file at `path`, opened as GDAL's `dataset` (a GDALDatasetH), holds all its
/// cells. GDAL reads as 0 those that lie beyond the end of a flat file: sea level in the middle of
/// a mountain. Text grids are complete where they were read; for TIFFs there is FindAbsentBlocks.
/// Errors: kUnsupportedData, kind "truncated"; kIo.
Status CheckComplete(void* dataset, const std::filesystem::path& path);

}  // namespace farhorizon

#pragma once

#include <cstdint>

#include "core/base/result.h"

namespace farhorizon {

/// Checks, before a cell is read, that `band` (a GDALRasterBandH) has at least 2 x 2 cells and at
/// most `max_posts`, and that its blocks, which GDAL decodes as a whole, do not dwarf it.
/// Errors: kUnsupportedData "too-small"; kResourceExhausted "raster-too-large", "block-too-large".
Status CheckRasterLimits(void* band, std::int64_t max_posts);

}  // namespace farhorizon

#pragma once

#include <cstdint>
#include <filesystem>

#include "core/base/result.h"

namespace farhorizon {

/// Checks the .hdr at `header` of an Esri raster (.bil, .bip, .bsq, .flt) whose numbers take
/// `bytes` bytes: GDAL takes what is missing or no number for 0, a missing byte order for the other
/// one, and cells as they come, whatever the length of a row.
///
/// Sizes must be whole numbers, the place must be there (ulxmap, ulymap, xdim and ydim, or
/// xllcorner, yllcorner and cellsize), the byte order must be stated for numbers of several bytes,
/// rows must follow one another without gaps, and the file must hold the cells and no more.
/// Errors: kUnsupportedData, kinds "not-a-raster", "truncated"; kIo.
Status CheckEsriHeader(const std::filesystem::path& header, std::int64_t bytes);

}  // namespace farhorizon

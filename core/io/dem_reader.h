#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "core/base/result.h"
#include "core/terrain/dem.h"

namespace farhorizon {

/// What a raster may be before it is read, and what the caller says in the file's stead.
struct DemReadOptions {
  std::int64_t max_posts = 64'000'000;
  std::optional<std::string> crs;  ///< overrides the file's
  std::optional<double> nodata;    ///< overrides or adds to the file's
};

/// Reads the one band of a raster (GTiff, AAIGrid, SRTMHGT, DTED, USGSDEM, ENVI) as a DEM.
///
/// Heights are exact: integers as they are; floats that are multiples of one power of two scaled;
/// anything else rounded to a stated quantum (`Dem::quantized`). Nodata and NaN become kNoHeight.
/// Overviews, side-car files and redirections are never opened.
/// Errors: kNotFound no such file; kUnsupportedData, by kind: "not-a-raster", "several-bands",
///   "no-crs", "rotated-geotransform", "degenerate-geotransform", "too-small", "all-nodata",
///   "infinite-height", "unsupported-type", "truncated"; kResourceExhausted "raster-too-large".
Result<Dem> ReadDem(const std::filesystem::path& path, const DemReadOptions& options);

}  // namespace farhorizon

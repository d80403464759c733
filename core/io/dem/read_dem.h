#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/terrain/dem.h"

namespace farhorizon {

/// The limit on rasters, and values that replace or complete those in the file.
struct DemReadOptions {
  std::int64_t max_posts = 64'000'000;
  std::optional<std::string> crs = {};             ///< overrides the file's
  std::optional<std::string> vertical_datum = {};  ///< overrides what `crs` or the file says
  std::vector<double> nodata = {};                 ///< beside the file's own
  std::optional<std::string> height_unit = {};     ///< "m", "ft" or "us-ft": overrides the file's
};

/// Reads the one band of a raster (GTiff, AAIGrid, SRTMHGT, DTED, USGSDEM, ENVI) as a DEM.
///
/// Heights are exact: integers as they are, floats scaled where they are multiples of one power of
/// two, others rounded to a stated quantum (`Dem::quantized`). Nodata, NaN and cells hidden by an
/// internal mask become kNoHeight. The band's scale, offset and unit (metres or feet) go into
/// quantum_m and height_offset_m. Rows and columns stay as the file has them (step_y > 0: south
/// first); posts are cell centres, whether the file calls its pixels areas or points.
/// Overviews, side-car files and redirections are never opened, except the .prj of an AAIGrid and
/// the .hdr that describes an ENVI raster. Messages name the file, not its folder.
/// Errors: kNotFound no such file; kInvalidArgument "virtual-path"; kUnsupportedData, by kind:
///   "not-a-raster", "several-bands", "no-crs", "rotated-geotransform", "degenerate-geotransform",
///   "too-small", "all-nodata", "infinite-height", "height-out-of-range", "unsupported-type",
///   "unknown-unit", "truncated"; kResourceExhausted "raster-too-large", "block-too-large", both
///   before any pixel is read.
/// Cost: at its peak 12 bytes a post.
Result<Dem> ReadDem(const std::filesystem::path& path, const DemReadOptions& options);

}  // namespace farhorizon

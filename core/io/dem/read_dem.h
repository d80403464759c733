#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
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
  std::vector<double> nodata = {};                 ///< raw values, beside the file's own
  std::optional<std::string> height_unit = {};     ///< "m", "ft" or "us-ft": overrides the file's
  /// Of a raster with more posts, or with a block of more, the heights stay unread.
  std::int64_t most_decoded = std::numeric_limits<std::int64_t>::max();
};

/// Reads the band of heights of a raster, of any format that OpenRaster opens, as a DEM.
///
/// Heights are exact: integers as they are, signed ones of any number of bits too; floats scaled
/// where they are multiples of one power of two, others rounded to a stated quantum
/// (`Dem::quantized`). The band's scale, offset and unit go into quantum_m and height_offset_m.
/// Rows and columns stay as the file has them (step_y > 0: south first); posts are cell centres,
/// whether the file calls its pixels areas or points.
///
/// kNoHeight are: NaN, the nodata values of the file, of its auxiliary file and of `options`, cells
/// that a mask hides (internal, an alpha band, FILE.msk), and values that no tag names but that no
/// ground on Earth has and that are customary for no data (untagged_voids.h).
///
/// `Dem::assumptions` has what the file leaves open or says twice; it is empty for a file that
/// states everything. Its codes, and how each is stated otherwise: proto/assumptions.md.
///
/// Of files beside, only FILE.aux.xml, FILE.msk, the world file, the .prj and the .hdr of a flat
/// raster are read; no name in any file is followed. Messages name the file, not its folder.
/// Errors: kNotFound no such file; kInvalidArgument "virtual-path"; kUnsupportedData, by kind:
///   "not-a-raster", "several-bands", "no-crs", "rotated-geotransform", "degenerate-geotransform",
///   "too-small", "all-nodata", "infinite-height", "height-out-of-range", "unsupported-type",
///   "unknown-unit", "truncated"; kResourceExhausted "raster-too-large", "block-too-large", both
///   before any pixel is read. Where `most_decoded` leaves the heights unread, they are empty, and
///   errors that only heights show are not found.
/// Cost: at its peak 12 bytes a post, 16 for text.
Result<Dem> ReadDem(const std::filesystem::path& path, const DemReadOptions& options);

}  // namespace farhorizon

#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/base/assumption.h"
#include "core/base/result.h"
#include "core/terrain/dem.h"

namespace farhorizon {

/// Where the posts of `dataset` (a GDALDatasetH, of the file at `path`) lie in its reference
/// system: by the file's own geotransform, else by its control points, else by a world file beside
/// it. What was taken from the world file, or is there and was not taken, is said in `assumptions`.
///
/// Rotations, shears and control points that move no post by more than a thousandth of a cell from
/// a grid along the axes are taken for such a grid. Rows may run from the south, columns from the
/// east.
/// Errors: kUnsupportedData, kinds "degenerate-geotransform", "rotated-geotransform".
Result<GeoTransform> ReadGeoTransform(void* dataset, const std::filesystem::path& path,
                                      Assumptions& assumptions);

/// The reference system of `dataset` (a GDALDatasetH, of the file at `path`) as PROJ reads it: the
/// file's own, else that of its control points, else that of the .prj beside it, which is said in
/// `assumptions`.
/// Errors: kUnsupportedData, kind "no-crs".
Result<std::string> ReadFileCrs(void* dataset, const std::filesystem::path& path,
                                Assumptions& assumptions);

}  // namespace farhorizon

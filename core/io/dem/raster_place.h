#pragma once

#include <optional>
#include <string>

#include "core/base/result.h"
#include "core/terrain/dem.h"

namespace farhorizon {

/// Where the posts of `dataset` (a GDALDatasetH) lie in its reference system.
/// Errors: kUnsupportedData, kinds "degenerate-geotransform", "rotated-geotransform".
Result<GeoTransform> ReadGeoTransform(void* dataset);

/// The reference system of `dataset` (a GDALDatasetH) as PROJ reads it, or `stated` where that is
/// set.
/// Errors: kUnsupportedData, kind "no-crs".
Result<std::string> ReadCrs(void* dataset, const std::optional<std::string>& stated);

}  // namespace farhorizon

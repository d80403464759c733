#pragma once

#include <string>

#include "core/base/assumption.h"
#include "core/base/result.h"
#include "core/terrain/dem.h"

namespace farhorizon {

struct OpenedDem;

/// Where the posts of `dem` lie in its reference system: by the geotransform of the auxiliary file,
/// else by the file's own, else by its control points, else by a world file beside it. What was
/// taken from the world file, or is there and was not taken, is said in the assumptions.
///
/// Rotations, shears and control points that move no post by more than a thousandth of a cell from
/// a grid along the axes are taken for such a grid. Rows may run from the south, columns from the
/// east.
/// Errors: kUnsupportedData, kinds "degenerate-geotransform", "rotated-geotransform".
Result<GeoTransform> ReadGeoTransform(OpenedDem& dem);

/// The reference system of `dem` as PROJ reads it: that of the auxiliary file, else the file's own,
/// else that of its control points, else that of the .prj beside it. That a .prj was taken, or says
/// otherwise and was not, is said in `assumptions`.
/// Errors: kUnsupportedData, kind "no-crs".
Result<std::string> ReadFileCrs(const OpenedDem& dem, Assumptions& assumptions);

}  // namespace farhorizon

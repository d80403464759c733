#pragma once

#include <optional>
#include <string>

#include "core/base/result.h"

namespace farhorizon {

struct OpenedDem;

/// The bound on heights and on a band's raw values, exclusive: Dem's at a quantum of 1.
inline constexpr double kMaxHeight = 1073741824;  // 2^30

/// Makes metres of a band's raw values: metres = raw * scale + offset. Upwards: scale is negative
/// for a band of depths.
struct ValueScale {
  double scale = 1;
  double offset = 0;
};

/// Reads scale, offset, unit and direction of the heights of `dem`. file_crs: the reference system
/// that the file has, or one beside it; unset where there is none.
///
/// The unit is that of DecideHeightUnit. Values count downwards where the file's vertical system
/// does, whatever --vertical-datum says, or where that of the call does; a system of --crs that has
/// heights takes the place of the file's. Adds to the assumptions: "height-unit"; "depths", where
/// they were turned; "vertical-datum", where nothing names one.
/// Errors: kUnsupportedData, kind "unknown-unit"; kind "unsupported-type" where scale or offset is
///   of no use; those of ReadCrsUnits and ReadHeightSystem for what the call states.
Result<ValueScale> ReadValueScale(OpenedDem& dem, const std::optional<std::string>& file_crs);

}  // namespace farhorizon

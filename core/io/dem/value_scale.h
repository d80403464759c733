#pragma once

#include <optional>

#include "core/base/result.h"

namespace farhorizon {

/// The bound on heights and on a band's raw values, exclusive: Dem's at a quantum of 1.
inline constexpr double kMaxHeight = 1073741824;  // 2^30

/// Makes metres of a band's raw values: metres = raw * scale + offset.
struct ValueScale {
  double scale = 1;
  double offset = 0;
};

/// Reads scale, offset and unit of `band` (a GDALRasterBandH) of `dataset` (a GDALDatasetH). Where
/// the band names no unit, a compound reference system's unit of heights counts.
/// Errors: kUnsupportedData, kind "unknown-unit"; kind "unsupported-type" where scale or offset is
///   of no use.
Result<ValueScale> ReadValueScale(void* dataset, void* band);

}  // namespace farhorizon

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

/// The values of a band that mean no data: NaN, and `forced` or, where that is unset, the band's
/// nodata value.
class NoDataRule {
 public:
  /// band: a GDALRasterBandH.
  NoDataRule(void* band, std::optional<double> forced);

  /// True where some value other than NaN means no data.
  [[nodiscard]] bool given() const { return value_.has_value(); }

  /// True where `value`, raw, means no data. Nodata values beyond any height (-1e37, -3.40282e+38)
  /// are written with few digits, six at least, so that text and bits may differ: those match
  /// within 1e-5 of their size. Others match as the band's type stores them.
  [[nodiscard]] bool Matches(double value) const;

 private:
  bool is_float_;
  std::optional<double> value_;
};

}  // namespace farhorizon

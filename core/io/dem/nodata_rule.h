#pragma once

#include <optional>
#include <vector>

namespace farhorizon {

/// The values of a band that mean no data: NaN, and `stated` or, where that is empty, the band's
/// nodata value.
class NoDataRule {
 public:
  /// band: a GDALRasterBandH.
  NoDataRule(void* band, const std::vector<double>& stated);

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

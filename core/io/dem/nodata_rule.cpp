// Which of a band's raw values mean no data.
#include "core/io/dem/nodata_rule.h"

#include <cmath>

#include <gdal.h>

#include "core/io/dem/value_scale.h"

namespace farhorizon {

NoDataRule::NoDataRule(void* band, const std::vector<double>& stated)
    : is_float_(GDALGetRasterDataType(band) == GDT_Float32) {
  int given = 0;
  double value = 0;
  switch (GDALGetRasterDataType(band)) {
    case GDT_Int64:
      value = static_cast<double>(GDALGetRasterNoDataValueAsInt64(band, &given));
      break;
    case GDT_UInt64:
      value = static_cast<double>(GDALGetRasterNoDataValueAsUInt64(band, &given));
      break;
    default:
      value = GDALGetRasterNoDataValue(band, &given);
  }
  if (given != 0) value_ = value;
  if (!stated.empty()) value_ = stated.front();
}

bool NoDataRule::Matches(double value) const {
  if (std::isnan(value)) return true;
  if (!value_) return false;
  if (value == *value_) return true;
  if (std::abs(*value_) >= kMaxHeight && std::isfinite(*value_)) {
    return std::abs(value - *value_) <= 1e-5 * std::abs(*value_);
  }
  return is_float_ && std::isfinite(*value_) &&
         static_cast<float>(value) == static_cast<float>(*value_);
}

}  // namespace farhorizon

// What a band's raw values mean: metres by scale, offset and unit, or no data.
#include "core/io/dem/value_scale.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include <gdal.h>
#include <ogr_srs_api.h>

namespace farhorizon {

namespace {

constexpr double kFoot = 0.3048;
constexpr double kSurveyFoot = 1200.0 / 3937;

Result<double> UnitInMetres(std::string name) {
  std::ranges::transform(name, name.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  static constexpr std::pair<std::string_view, double> kUnits[] = {{"", 1},
                                                                   {"m", 1},
                                                                   {"metre", 1},
                                                                   {"metres", 1},
                                                                   {"meter", 1},
                                                                   {"meters", 1},
                                                                   {"ft", kFoot},
                                                                   {"foot", kFoot},
                                                                   {"feet", kFoot},
                                                                   {"international foot", kFoot},
                                                                   {"us-ft", kSurveyFoot},
                                                                   {"ftus", kSurveyFoot},
                                                                   {"us survey foot", kSurveyFoot},
                                                                   {"foot_us", kSurveyFoot},
                                                                   {"us_foot", kSurveyFoot},
                                                                   {"sfoot", kSurveyFoot},
                                                                   {"km", 1000},
                                                                   {"dm", 0.1},
                                                                   {"cm", 0.01},
                                                                   {"mm", 0.001}};
  for (const auto& [known, metres] : kUnits) {
    if (name == known) return metres;
  }
  return Error{ErrorCode::kUnsupportedData,
               "the band's values are in \"" + name.substr(0, 40) +
                   "\", heights must be in metres or feet; set the unit with gdal_edit -units",
               "unknown-unit"};
}

}  // namespace

Result<ValueScale> ReadValueScale(void* dataset, void* band) {
  Result<double> unit = UnitInMetres(GDALGetRasterUnitType(band));
  if (!unit) return std::move(unit.error());
  const OGRSpatialReferenceH crs = GDALGetSpatialRef(dataset);
  if (*GDALGetRasterUnitType(band) == '\0' && crs != nullptr && OSRIsCompound(crs) != 0) {
    unit = OSRGetTargetLinearUnits(crs, "VERT_CS", nullptr);
  }
  const double scale = GDALGetRasterScale(band, nullptr);
  const double offset = GDALGetRasterOffset(band, nullptr);
  if (!std::isfinite(scale) || scale == 0 || !std::isfinite(offset)) {
    return Error{ErrorCode::kUnsupportedData,
                 "the band's scale (" + std::to_string(scale) + ") or offset (" +
                     std::to_string(offset) + ") is of no use; set them with gdal_edit",
                 "unsupported-type"};
  }
  return ValueScale{scale * *unit, offset * *unit};
}

}  // namespace farhorizon

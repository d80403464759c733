#include "core/geo/ellipsoid.h"

#include <cmath>

namespace farhorizon {

Ecef EcefOf(const Geodetic& p) {
  const double lat = p.lat_deg * kRadiansPerDegree;
  const double lon = p.lon_deg * kRadiansPerDegree;
  const double normal_x = std::cos(lat) * std::cos(lon);
  const double normal_y = std::cos(lat) * std::sin(lon);
  const double normal_z = std::sin(lat);
  constexpr double kEquatorial2 = kEquatorialRadiusM * kEquatorialRadiusM;
  constexpr double kPolar2 = kPolarRadiusM * kPolarRadiusM;
  const double gamma = std::sqrt(kEquatorial2 * (normal_x * normal_x + normal_y * normal_y) +
                                 kPolar2 * normal_z * normal_z);
  return {normal_x * (kEquatorial2 / gamma + p.height_m),
          normal_y * (kEquatorial2 / gamma + p.height_m),
          normal_z * (kPolar2 / gamma + p.height_m)};
}

}  // namespace farhorizon

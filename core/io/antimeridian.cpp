#include "core/io/antimeridian.h"

#include <cmath>

namespace farhorizon {

namespace {

constexpr double kHalfTurn = 180;
// Half of the last decimal that files have (kDegreeDecimals, geojson_text.h).
constexpr double kShownAsHalfTurn = kHalfTurn - 0.5e-9;

// `p` with the sign of `other`'s longitude where it lies on the meridian.
Geodetic Beside(Geodetic p, const Geodetic& other) {
  if (std::abs(p.lon_deg) >= kShownAsHalfTurn) p.lon_deg = std::copysign(kHalfTurn, other.lon_deg);
  return p;
}

}  // namespace

std::vector<std::array<Geodetic, 2>> CutAtAntimeridian(Geodetic a, Geodetic b) {
  b = Beside(b, a);
  a = Beside(a, b);
  if (std::abs(b.lon_deg - a.lon_deg) <= kHalfTurn) return {{a, b}};
  const double meridian = std::copysign(kHalfTurn, a.lon_deg);
  const double t = (meridian - a.lon_deg) / (b.lon_deg + 2 * meridian - a.lon_deg);
  Geodetic end = {meridian, a.lat_deg + t * (b.lat_deg - a.lat_deg),
                  a.height_m + t * (b.height_m - a.height_m)};
  Geodetic begin = end;
  begin.lon_deg = -meridian;
  return {{a, end}, {begin, b}};
}

}  // namespace farhorizon

#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "core/geo/frames.h"

// The closed formulas of EPSG Guidance Note 7-2 (September 2019), without PROJ: the slow twin of
// core/geo. Section numbers are the note's.
namespace farhorizon::by_formula {

inline constexpr double kA = 6378137;            // WGS 84, semi-major axis, metres
inline constexpr double kF = 1 / 298.257223563;  // flattening
inline constexpr double kE2 = kF * (2 - kF);     // eccentricity squared
inline constexpr double kRad = std::numbers::pi / 180;

/// Geographic to geocentric, method 9602 (section 4.1.1).
inline Ecef ToEcef(Geodetic g) {
  const double lat = g.lat_deg * kRad;
  const double lon = g.lon_deg * kRad;
  const double nu = kA / std::sqrt(1 - kE2 * std::sin(lat) * std::sin(lat));
  return {(nu + g.height_m) * std::cos(lat) * std::cos(lon),
          (nu + g.height_m) * std::cos(lat) * std::sin(lon),
          ((1 - kE2) * nu + g.height_m) * std::sin(lat)};
}

/// Geocentric to geographic, the iteration of the same section, until nothing changes.
inline Geodetic ToGeodetic(Ecef p) {
  const double across = std::hypot(p.x, p.y);
  double lat = std::atan2(p.z, across * (1 - kE2));
  double nu = kA;
  for (int i = 0; i < 100; ++i) {
    nu = kA / std::sqrt(1 - kE2 * std::sin(lat) * std::sin(lat));
    lat = std::atan2(p.z + kE2 * nu * std::sin(lat), across);
  }
  // Along the normal in either direction, so that neither pole nor equator loses digits.
  const double height = across * std::cos(lat) + p.z * std::sin(lat) - kA * kA / nu;
  return {std::atan2(p.y, p.x) / kRad, lat / kRad, height};
}

/// Geocentric to topocentric, method 9836 (section 4.1.2).
inline Enu ToEnu(Geodetic origin, Ecef p) {
  const Ecef o = ToEcef(origin);
  const double lat = origin.lat_deg * kRad;
  const double lon = origin.lon_deg * kRad;
  const double dx = p.x - o.x;
  const double dy = p.y - o.y;
  const double dz = p.z - o.z;
  return {
      -std::sin(lon) * dx + std::cos(lon) * dy,
      -std::sin(lat) * std::cos(lon) * dx - std::sin(lat) * std::sin(lon) * dy + std::cos(lat) * dz,
      std::cos(lat) * std::cos(lon) * dx + std::cos(lat) * std::sin(lon) * dy + std::sin(lat) * dz};
}

/// Popular Visualisation Pseudo Mercator (EPSG:3857), method 1024, inverse.
inline std::array<double, 2> FromWebMercator(double x, double y) {
  return {x / kA / kRad, (std::numbers::pi / 2 - 2 * std::atan(std::exp(-y / kA))) / kRad};
}

/// Transverse Mercator, method 9807, the JHS formulas: UTM of WGS 84, zone by central meridian,
/// northern hemisphere. Easting and northing, metres; good to a few micrometres within the zone
/// (the series ends at the fourth power of n).
inline std::array<double, 2> ToUtm(double lon_deg, double lat_deg, double meridian_deg) {
  const double n = kF / (2 - kF);
  const double b = kA / (1 + n) * (1 + n * n / 4 + n * n * n * n / 64);
  const std::array<double, 4> h = {
      n / 2 - 2. / 3 * n * n + 5. / 16 * n * n * n + 41. / 180 * n * n * n * n,
      13. / 48 * n * n - 3. / 5 * n * n * n + 557. / 1440 * n * n * n * n,
      61. / 240 * n * n * n - 103. / 140 * n * n * n * n, 49561. / 161280 * n * n * n * n};
  const double e = std::sqrt(kE2);
  const double lat = lat_deg * kRad;
  const double turn = (lon_deg - meridian_deg) * kRad;
  const double q = std::asinh(std::tan(lat)) - e * std::atanh(e * std::sin(lat));
  const double beta = std::atan(std::sinh(q));
  const double eta0 = std::atanh(std::cos(beta) * std::sin(turn));
  const double xi0 = std::asin(std::sin(beta) * std::cosh(eta0));
  double xi = xi0;
  double eta = eta0;
  for (std::size_t k = 0; k < h.size(); ++k) {
    const double m = 2 * static_cast<double>(k + 1);
    xi += h[k] * std::sin(m * xi0) * std::cosh(m * eta0);
    eta += h[k] * std::cos(m * xi0) * std::sinh(m * eta0);
  }
  return {500000 + 0.9996 * b * eta, 0.9996 * b * xi};
}

}  // namespace farhorizon::by_formula

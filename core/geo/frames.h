#pragma once

#include <array>

namespace farhorizon {

/// Longitude and latitude, degrees, and height above the WGS 84 ellipsoid, metres.
struct Geodetic {
  double lon_deg = 0;
  double lat_deg = 0;
  double height_m = 0;
};

/// Earth-centred, earth-fixed (EPSG:4978), metres.
struct Ecef {
  double x = 0;
  double y = 0;
  double z = 0;
};

/// East, north, up about a TangentFrame's origin, metres.
struct Enu {
  double east = 0;
  double north = 0;
  double up = 0;
};

/// The local frame at a point of the ellipsoid: `up` along the ellipsoid's normal. A job has one.
class TangentFrame {
 public:
  /// Requires: both are the same point.
  TangentFrame(Geodetic origin, Ecef origin_ecef);

  [[nodiscard]] Geodetic origin() const { return origin_; }
  [[nodiscard]] Enu ToEnu(Ecef p) const;
  [[nodiscard]] Ecef ToEcef(Enu p) const;
  /// The 4 x 4 matrix of ToEcef, column-major, as the `transform` of [3D Tiles].
  [[nodiscard]] std::array<double, 16> EnuToEcef() const;

 private:
  Geodetic origin_;
  Ecef origin_ecef_;
  std::array<double, 3> east_;
  std::array<double, 3> north_;
  std::array<double, 3> up_;
};

}  // namespace farhorizon

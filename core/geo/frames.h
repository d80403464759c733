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

/// Along the axes of a TangentFrame from its origin, metres: east, north and up where it is the
/// tile's own.
struct Enu {
  double east = 0;
  double north = 0;
  double up = 0;
};

/// A local frame: right angles, metres. A job has one. Heights are along EllipsoidNormal, which is
/// the third axis at one point of the globe at most.
class TangentFrame {
 public:
  /// East, north and up, along the ellipsoid's normal, at a point of the ellipsoid.
  /// Requires: both are the same point.
  TangentFrame(Geodetic origin, Ecef origin_ecef);
  /// Earth-fixed axes, from the Earth's centre.
  static TangentFrame EarthFixed();

  /// The same axes with the origin at `origin`. Coordinates are those in this frame less `origin`,
  /// rounded once: frames moved from one are one lattice where they are moved by whole steps.
  [[nodiscard]] TangentFrame MovedTo(const Enu& origin) const;

  [[nodiscard]] Enu ToEnu(Ecef p) const;
  [[nodiscard]] Ecef ToEcef(Enu p) const;
  /// The 4 x 4 matrix of ToEcef, column-major, as the `transform` of [3D Tiles].
  [[nodiscard]] std::array<double, 16> EnuToEcef() const;

 private:
  TangentFrame() = default;

  // The axes meet at base_; the origin is `moved_` along them from there.
  Ecef base_;
  Enu moved_;
  std::array<double, 3> east_ = {1, 0, 0};
  std::array<double, 3> north_ = {0, 1, 0};
  std::array<double, 3> up_ = {0, 0, 1};
};

}  // namespace farhorizon

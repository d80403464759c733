#pragma once

#include <array>

namespace farhorizon {

/// Height above the WGS 84 ellipsoid.
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

/// The local frame that touches the ellipsoid's normal at a point: one a job.
class TangentFrame {
 public:
  TangentFrame(Geodetic origin, Ecef origin_ecef);

  [[nodiscard]] Geodetic origin() const { return origin_; }
  [[nodiscard]] Enu ToEnu(Ecef p) const;
  [[nodiscard]] Ecef ToEcef(Enu p) const;
  /// Column-major 4 x 4, as a 3D Tiles `transform`.
  [[nodiscard]] std::array<double, 16> EnuToEcef() const;

 private:
  Geodetic origin_;
  Ecef origin_ecef_;
  std::array<double, 3> east_;
  std::array<double, 3> north_;
  std::array<double, 3> up_;
};

}  // namespace farhorizon

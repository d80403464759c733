#include "core/geo/frames.h"

#include <cmath>
#include <numbers>

namespace farhorizon {

// The topocentric frame of EPSG Guidance Note 7-2, method 9836: columns are the unit vectors east,
// north and up (along the ellipsoid's normal) at the origin, in earth-fixed axes.
TangentFrame::TangentFrame(Geodetic origin, Ecef origin_ecef) : base_(origin_ecef) {
  const double lon = origin.lon_deg * std::numbers::pi / 180;
  const double lat = origin.lat_deg * std::numbers::pi / 180;
  const double sin_lon = std::sin(lon);
  const double cos_lon = std::cos(lon);
  const double sin_lat = std::sin(lat);
  const double cos_lat = std::cos(lat);
  east_ = {-sin_lon, cos_lon, 0};
  north_ = {-sin_lat * cos_lon, -sin_lat * sin_lon, cos_lat};
  up_ = {cos_lat * cos_lon, cos_lat * sin_lon, sin_lat};
}

TangentFrame TangentFrame::EarthFixed() { return {}; }

TangentFrame TangentFrame::MovedTo(const Enu& origin) const {
  TangentFrame moved = *this;
  moved.moved_ = {moved_.east + origin.east, moved_.north + origin.north, moved_.up + origin.up};
  return moved;
}

Enu TangentFrame::ToEnu(Ecef p) const {
  const double x = p.x - base_.x;
  const double y = p.y - base_.y;
  const double z = p.z - base_.z;
  const auto along = [&](const std::array<double, 3>& axis) {
    return axis[0] * x + axis[1] * y + axis[2] * z;
  };
  return {along(east_) - moved_.east, along(north_) - moved_.north, along(up_) - moved_.up};
}

Ecef TangentFrame::ToEcef(Enu p) const {
  const Enu q = {moved_.east + p.east, moved_.north + p.north, moved_.up + p.up};
  const auto component = [&](std::size_t i) {
    return east_[i] * q.east + north_[i] * q.north + up_[i] * q.up;
  };
  return {base_.x + component(0), base_.y + component(1), base_.z + component(2)};
}

std::array<double, 16> TangentFrame::EnuToEcef() const {
  const Ecef origin = ToEcef({0, 0, 0});
  return {east_[0], east_[1], east_[2], 0, north_[0], north_[1], north_[2], 0,
          up_[0],   up_[1],   up_[2],   0, origin.x,  origin.y,  origin.z,  1};
}

}  // namespace farhorizon

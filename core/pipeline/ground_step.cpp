#include "core/pipeline/ground_step.h"

#include <cmath>
#include <numbers>

namespace farhorizon {

namespace {

constexpr double kDegreesPerRadian = 180 / std::numbers::pi;

}  // namespace

double GroundStep::ToAzimuth(double columns, double rows) const {
  const auto [east, north] = ToGround(columns, rows);
  return std::atan2(east, north) * kDegreesPerRadian;
}

std::array<double, 2> GroundStep::ToGrid(double azimuth_deg) const {
  const double east = std::sin(azimuth_deg / kDegreesPerRadian);
  const double north = std::cos(azimuth_deg / kDegreesPerRadian);
  const double area = SignedCellArea();
  return {(east * row_north_m - north * row_east_m) / area,
          (north * column_east_m - east * column_north_m) / area};
}

}  // namespace farhorizon

#pragma once

#include <numbers>

#include "core/geo/frames.h"

namespace farhorizon {

/// The semi-axes of WGS 84, metres.
inline constexpr double kEquatorialRadiusM = 6378137.0;
inline constexpr double kPolarRadiusM = 6356752.314245179;

inline constexpr double kRadiansPerDegree = std::numbers::pi / 180;

/// The earth-fixed place of a point, in closed form: what clients of quantized-mesh compute.
Ecef EcefOf(const Geodetic& p);

}  // namespace farhorizon

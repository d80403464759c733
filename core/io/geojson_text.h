#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>

#include "core/geo/frames.h"

namespace farhorizon {

/// Decimals of coordinates in files: a tenth of a millimetre on the ground, and in height.
inline constexpr int kDegreeDecimals = 9;
inline constexpr int kMetreDecimals = 4;

/// The shortest text of `value` rounded to `decimals`, without exponent; never "-0".
std::string Rounded(double value, int decimals);

/// The shortest text that reads back to the same number.
std::string Exact(double value);

/// "[p,q,...]".
std::string Bracketed(std::initializer_list<std::string> parts);

/// "[longitude,latitude,height]".
std::string Coordinates(const Geodetic& g);

/// The geometry of the line from `from` to `to`: a LineString, or where it crosses the meridian of
/// 180 degrees a MultiLineString of the parts on both sides of it (CutAtAntimeridian).
std::string LineGeometry(const Geodetic& from, const Geodetic& to);

/// "[first,second]".
std::string Pair(std::int64_t first, std::int64_t second);

}  // namespace farhorizon

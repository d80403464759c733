#pragma once

#include <array>
#include <vector>

#include "core/geo/frames.h"

namespace farhorizon {

/// The straight line in longitude and latitude from `a` to `b`, cut where it crosses the meridian
/// of 180 degrees [RFC 7946, section 3.1.9]: one part, or two, the first of which ends at 180 or
/// -180 and the second of which begins at the other.
///
/// Lines go the shorter way round: ends whose longitudes differ by more than half a turn lie on
/// both sides of the meridian. An end that files show at 180 or -180 lies on the meridian, and
/// takes the sign of the other end.
/// Requires: longitudes within [-180, 180].
std::vector<std::array<Geodetic, 2>> CutAtAntimeridian(Geodetic a, Geodetic b);

}  // namespace farhorizon

#pragma once

#include "core/geo/frames.h"

namespace farhorizon {

/// Upwards at `p`, of no particular length: the normal of the ellipsoid through p, right to 5e-6 up
/// to 9 km of height. Linear in p.
Enu EllipsoidNormal(const Enu& p, const TangentFrame& frame);

}  // namespace farhorizon

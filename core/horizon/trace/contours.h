#pragma once

#include <cstdint>
#include <vector>

#include "core/terrain/terrain.h"

namespace farhorizon {

/// A point of the plan: columns and rows, fractional.
struct PlanPoint {
  double x = 0;
  double y = 0;
};

/// The contours of SweepTrace. Ground at the level itself is inside.
std::vector<std::vector<PlanPoint>> ContoursAt(const Terrain& terrain, std::int32_t level);

}  // namespace farhorizon

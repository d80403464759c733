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

/// The border of the slice at `height`, in quanta, inside the terrain: contours with the ground at
/// or above the height on one side. Closed ones end where they begin, the others at the border of
/// the terrain or of a hole. Cost: O(triangles log triangles).
std::vector<std::vector<PlanPoint>> ContoursAt(const Terrain& terrain, std::int32_t height);

}  // namespace farhorizon

#pragma once

#include <optional>

#include "core/terrain/dem.h"

namespace farhorizon {

/// The height of the triangulated DEM at a point of the plan, metres: over the triangles of
/// Terrain. nullopt outside the grid, and where a corner of the triangle there has no data.
std::optional<double> TerrainHeightAt(const Dem& dem, double column, double row);

}  // namespace farhorizon

#pragma once

#include <cstdint>
#include <random>

#include "core/terrain/dem.h"

namespace farhorizon {

/// A small DEM of a random kind that has at least one triangle: landscapes, white noise, flat
/// ground, cliffs of 2^20, a few spikes, one slope, with and without holes; holes make slanted
/// outlines and posts where two fans meet. Sizes from 2 x 2 to most_side a side, among them strips
/// of two rows or columns; some consist of one triangle.
Dem AnySmallDem(std::int32_t most_side, std::mt19937& random);

/// The same with heights in quanta of other sizes than a metre, off zero.
Dem AnySmallDemInQuanta(std::int32_t most_side, std::mt19937& random);

/// AnyLandscape (terrains.h) with at least one triangle.
Dem AnySolidLandscape(std::int32_t min_side, std::int32_t max_side, std::mt19937& random);

}  // namespace farhorizon

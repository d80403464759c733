#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/terrain/dem.h"

namespace farhorizon {

/// Any DEM of 2 to 9 posts a side, from any bytes: those that are missing are 0, those left over do
/// nothing. Made so that small changes of the bytes are small changes of the terrain, and so that
/// what is hard is near: equal heights, posts in line or in a plane, cliffs whose tops differ by
/// quanta, holes, heights up to the limit of |z| < 2^30.
///
/// Bytes: columns, rows, kind of heights, number of rectangles; for each of those what it is, its
/// corner, its size, its height; then a byte a post (four, where the kind is kWide), 255 a hole.
Dem DemFromBytes(std::span<const std::uint8_t> bytes);

}  // namespace farhorizon

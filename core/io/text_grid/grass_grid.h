#pragma once

#include <filesystem>

#include "core/base/result.h"
#include "core/io/text_grid/text_grid.h"

namespace farhorizon {

/// Reads a GRASS ASCII raster (r.out.ascii): north:, south:, east:, west:, rows:, cols:, null: and
/// type: where they are there, then the cells, row by row from the north. A cell that is the word
/// of null:, or "*", is NaN.
/// Errors and cost: as ReadArcGrid.
Result<TextGrid> ReadGrassGrid(const std::filesystem::path& path, const GridLimits& limits);

}  // namespace farhorizon

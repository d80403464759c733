#pragma once

#include <filesystem>

#include "core/base/result.h"
#include "core/io/text_grid/text_grid.h"

namespace farhorizon {

/// Reads a text grid of Golden Software's Surfer 6 ("DSAA"): columns and rows, the first and the
/// last x, y and height, then the cells, row by row from the south. 1.70141e38 is no data.
/// Errors and cost: as ReadArcGrid.
Result<TextGrid> ReadSurferGrid(const std::filesystem::path& path, const GridLimits& limits);

}  // namespace farhorizon

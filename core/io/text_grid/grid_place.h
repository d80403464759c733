#pragma once

#include <array>
#include <cstdint>

#include "core/base/result.h"
#include "core/io/text_grid/grid_header.h"

namespace farhorizon {

/// The geotransform, as GDAL has it, of a grid of `rows` rows whose header names its south-western
/// corner or the centre of the cell there: xllcorner or xllcenter, yllcorner or yllcenter, cellsize
/// or dx and dy. What is said twice must agree within a millionth of a cell.
/// Errors: kUnsupportedData "not-a-raster", which names what is missing, no number or said twice.
Result<std::array<double, 6>> LowerLeftPlace(const GridHeader& header, std::int64_t rows);

}  // namespace farhorizon

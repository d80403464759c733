#pragma once

#include <filesystem>

#include "core/base/result.h"
#include "core/io/text_grid/text_grid.h"

namespace farhorizon {

/// Reads an Arc/Info ASCII grid (Esri; AAIGrid in GDAL): a header of ncols, nrows, xllcorner or
/// xllcenter, yllcorner or yllcenter, cellsize or dx and dy, NODATA_value where there is one, then
/// the cells, row by row from the north.
///
/// All of the header must be there, say each thing once and be numbers; the cells must be
/// columns * rows in lines that fit (GridLines). A cell that is no number is NaN where NODATA_value
/// is just that word ("NA", "null", "-").
/// Errors: kUnsupportedData, kinds "not-a-raster", "truncated"; kResourceExhausted
///   "raster-too-large" where the header says more than `limits.max_cells`; kIo.
/// Cost: one pass; 4 bytes for each cell that the file has, however many the header says. Where the
///   cells stay unread, only the header is read.
Result<TextGrid> ReadArcGrid(const std::filesystem::path& path, const GridLimits& limits);

}  // namespace farhorizon

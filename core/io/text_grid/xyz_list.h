#pragma once

#include <filesystem>

#include "core/base/result.h"
#include "core/io/text_grid/text_grid.h"

namespace farhorizon {

/// What a list of points says of itself.
struct XyzGrid {
  TextGrid grid;
  bool order_is_stated = false;  ///< a first line names the columns
};

/// Reads a list of points, x (easting, longitude), y and height a line, in any order, that lie on a
/// grid; cells that it leaves out have no data. A first line may name the columns, in any order:
/// x, easting, longitude; y, northing, latitude; z, height, elevation.
///
/// The grid has the spacing of points that follow one another. A point may lie a twentieth of a
/// cell off, since coordinates are rounded; a cell may stand in the list once, and half of the
/// cells must.
/// Errors: kUnsupportedData "not-a-raster", which names the line; kResourceExhausted
///   "raster-too-large"; kIo.
/// Cost: two passes; 4 bytes a cell. Where the cells stay unread, one pass.
Result<XyzGrid> ReadXyzList(const std::filesystem::path& path, const GridLimits& limits);

}  // namespace farhorizon

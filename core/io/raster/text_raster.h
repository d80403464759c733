#pragma once

#include <filesystem>

#include "core/base/result.h"
#include "core/io/file_kind/file_kind.h"
#include "core/io/raster/open_raster.h"

namespace farhorizon {

/// Reads the text grid of `kind` at `path` into a dataset in memory. The reference system of an
/// Arc/Info grid is that of the .prj beside, where there is one. What it assumes: "xyz-order".
/// Cells that stay unread are 0 there, which nobody may ask for.
/// Requires: a GdalSession; `kind` is one of the text grids.
/// Errors: as ReadArcGrid; kResourceExhausted where memory does not suffice.
/// Cost: one pass; 8 bytes a cell at its peak, 4 of which stay until the dataset is closed.
Result<OpenedRaster> OpenTextRaster(const std::filesystem::path& path, FileKind kind,
                                    const GridLimits& limits);

}  // namespace farhorizon

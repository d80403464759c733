#pragma once

#include <cstdint>
#include <filesystem>

#include "core/base/result.h"

namespace farhorizon {

/// Whether the Arc/Info ASCII grid at `path` has a number for each of its `posts` cells, and
/// nothing but numbers after its header. GDAL reads cells that are missing, and words, as 0.
/// Errors: kUnsupportedData "truncated" too few; "not-a-raster" something that is no number; kIo.
/// Cost: one pass over the text.
Status CheckAsciiGrid(const std::filesystem::path& path, std::int64_t posts);

}  // namespace farhorizon

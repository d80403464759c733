#pragma once

#include <cstdint>
#include <filesystem>

#include "core/base/result.h"

namespace farhorizon {

/// Checks that the Arc/Info ASCII grid at `path` has a number for each of its `posts` cells, and
/// only numbers after its header. GDAL reads missing cells, and words, as 0.
/// Errors: kUnsupportedData, kind "truncated", for too few numbers, "not-a-raster" for a word; kIo.
/// Cost: one pass over the text.
Status CheckAsciiGrid(const std::filesystem::path& path, std::int64_t posts);

}  // namespace farhorizon

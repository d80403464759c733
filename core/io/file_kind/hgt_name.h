#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace farhorizon {

/// Whether `filename` is that of an SRTM HGT tile: its south-western corner, a point and "hgt" at
/// the end, such as "N46E007.hgt" or "s01w078.SRTMGL1.hgt". The name is all that says where it is.
bool IsHgtName(std::string_view filename);

/// Whether `filename` ends with `ending` (lower case), in small or capital letters.
bool HasEnding(std::string_view filename, std::string_view ending);

/// Whether a tile of `bytes` bytes is whole: 16-bit numbers in squares of 1201, 1801, 3601 or 7201
/// posts a side, or 3601 rows of 1801, as the tiles of the far north are.
bool IsHgtSize(std::int64_t bytes);

/// Why a file that ends with ".hgt" is not read, and what makes it readable; nullopt where its name
/// and its size are those of a tile.
/// Errors, as a value: kUnsupportedData, kinds "not-a-raster" for the name, "truncated" for the
///   size.
std::optional<Error> HgtFault(std::string_view filename, std::int64_t bytes);

}  // namespace farhorizon

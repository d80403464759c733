#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/io/tileset.h"

namespace farhorizon {

/// The claims of a tileset.json that WriteTileset made, for verification. levels: level 0 first.
/// transform: from the local frame to ECEF, column-major.
struct TilesetContents {
  std::vector<TilesetLevel> levels;
  double root_error_m = 0;
  std::array<double, 16> transform = {};
};

/// Errors: kUnsupportedData, kind "bad-tileset", where `text` is no chain of tiles.
Result<TilesetContents> ReadTileset(const std::string& text);

}  // namespace farhorizon

#pragma once

#include <array>
#include <string>

#include "core/base/result.h"
#include "core/io/tileset.h"

namespace farhorizon {

/// The claims of a tileset.json that WriteTileset made, for verification. transform: from the local
/// frame to ECEF, column-major.
struct TilesetContents {
  TilesetTile root;
  double root_error_m = 0;
  std::array<double, 16> transform = {};
};

/// Errors: kUnsupportedData, kind "bad-tileset", where `text` is no such tileset, or has more than
/// kMostTilesDeep tiles below one another.
Result<TilesetContents> ReadTileset(const std::string& text);

/// A build has at most 12 levels, and a tile without content above them.
inline constexpr int kMostTilesDeep = 16;

}  // namespace farhorizon

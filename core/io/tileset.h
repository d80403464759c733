#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/geo/frames.h"

namespace farhorizon {

/// Radians, and metres above the ellipsoid: a 3D Tiles region.
struct BoundingRegion {
  double west = 0;
  double south = 0;
  double east = 0;
  double north = 0;
  double min_height_m = 0;
  double max_height_m = 0;
};

/// One level of a tileset.
struct TilesetLevel {
  std::string uri;
  double geometric_error_m = 0;
};

/// tileset.json (3D Tiles 1.1): explicit tiling, REPLACE, a tile for each level, coarsest at the
/// root. levels: level 0 (finest) first. root_error_m: the error of drawing nothing, about the
/// tile's size. transform: local frame to ECEF, column-major.
std::string WriteTileset(const std::vector<TilesetLevel>& levels, const BoundingRegion& region,
                         double root_error_m, const std::array<double, 16>& transform);

/// What a tileset.json that WriteTileset made says, for verification. levels: level 0 first.
struct TilesetContents {
  std::vector<TilesetLevel> levels;
  double root_error_m = 0;
  std::array<double, 16> transform = {};
};
/// Errors: kUnsupportedData where it is no chain of tiles.
Result<TilesetContents> ReadTileset(const std::string& text);

}  // namespace farhorizon

#pragma once

#include <array>
#include <string>
#include <vector>

namespace farhorizon {

/// A region of 3D Tiles: radians of longitude and latitude, metres above the ellipsoid.
struct BoundingRegion {
  double west = 0;
  double south = 0;
  double east = 0;
  double north = 0;
  double min_height_m = 0;
  double max_height_m = 0;
};

/// One level of a tileset. uri: of its content, relative to the tileset.
struct TilesetLevel {
  std::string uri;
  double geometric_error_m = 0;
};

/// The text of tileset.json [3D Tiles]: explicit tiling, refinement REPLACE, a tile for each level,
/// the coarsest at the root.
///
/// levels: level 0 (finest) first. root_error_m: the error of drawing nothing, about the tile's
/// size. transform: from the local frame to ECEF, column-major.
/// Requires: at least one level.
std::string WriteTileset(const std::vector<TilesetLevel>& levels, const BoundingRegion& region,
                         double root_error_m, const std::array<double, 16>& transform);

}  // namespace farhorizon

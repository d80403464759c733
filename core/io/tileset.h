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

/// A tile and those that take its place where more detail is asked for.
///
/// uri: of its content, relative to the tileset; empty: it has none, and its children are always
/// drawn.
struct TilesetTile {
  std::string uri;
  double geometric_error_m = 0;
  BoundingRegion region;
  std::vector<TilesetTile> children;
};

/// The text of tileset.json [3D Tiles]: explicit tiling, refinement REPLACE.
///
/// root_error_m: the error of drawing nothing, about the tile's size. transform: from the local
/// frame to ECEF, column-major. Errors of tiles are raised to those of their children: clients
/// refine while the error is too great, and would stop at a smaller one.
std::string WriteTileset(const TilesetTile& root, double root_error_m,
                         const std::array<double, 16>& transform);

}  // namespace farhorizon

#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/geo/frames.h"

namespace farhorizon {

/// The greatest number of a quantized coordinate: u, v and height run from 0 to it.
inline constexpr int kMostQuantized = 32767;

/// A rectangle of longitude and latitude, degrees.
struct TileRectangle {
  double west = 0;
  double south = 0;
  double east = 0;
  double north = 0;
};

/// A vertex of a tile. u, v, height: 0 at the west, south and least height, kMostQuantized at the
/// east, north and greatest. normal: earth-fixed, of length 1.
struct QuantizedVertex {
  std::uint16_t u = 0;
  std::uint16_t v = 0;
  std::uint16_t height = 0;
  std::array<float, 3> normal = {0, 0, 1};
};

/// A tile of quantized-mesh 1.0 [Quantized-mesh].
///
/// heights_m: the least and the greatest, above the ellipsoid. triangles: counter-clockwise from
/// outside. Vertices whose u or v is 0 or kMostQuantized are on the tile's sides.
struct QuantizedTile {
  TileRectangle rectangle;
  std::array<float, 2> heights_m = {0, 0};
  std::vector<QuantizedVertex> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Where a client puts a vertex of the tile.
Geodetic PlaceOf(const QuantizedTile& tile, const QuantizedVertex& vertex);

/// The bytes of the tile, not compressed: header with its real bounding sphere and horizon
/// occlusion point, vertices, triangles, the vertices of the four sides, the extensions
/// octvertexnormals and metadata.
///
/// Vertices are renumbered in the order in which triangles name them first. Where a tile is too
/// wide to have a horizon occlusion point, it is not a number: no comparison with it then hides
/// the tile. metadata: the JSON text of that extension.
/// Requires: at least one triangle; each vertex is in one; fewer than 2^32 bytes.
std::string EncodeQuantizedMesh(const QuantizedTile& tile, const std::string& metadata);

}  // namespace farhorizon

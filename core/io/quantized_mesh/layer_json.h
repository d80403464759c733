#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace farhorizon {

/// A tile of the globe's quadtree in longitude and latitude: 2 x 1 tiles at zoom 0, y from the
/// south (EPSG:4326, TMS).
struct TileAddress {
  int zoom = 0;
  std::int64_t x = 0;
  std::int64_t y = 0;
  friend auto operator<=>(const TileAddress&, const TileAddress&) = default;
};

/// The file of a tile, beside layer.json: "terrain-Z-X-Y.terrain".
std::string TileName(const TileAddress& tile);

/// The text of layer.json [Quantized-mesh]: the tiles that there are, where they lie, and what they
/// hold.
///
/// Clients of the metadata extension, CesiumJS among them, read what is available from the tiles at
/// zoom 0 (MetadataOfTile), others from layer.json.
/// Requires: tiles rise, each once; both tiles of zoom 0 are among them.
std::string WriteLayerJson(const std::vector<TileAddress>& tiles);

/// The JSON text of a tile's metadata extension: its error, and, at zoom 0, the tiles that there
/// are. Requires: as WriteLayerJson has it.
std::string MetadataOfTile(const TileAddress& tile, double geometric_error_m,
                           const std::vector<TileAddress>& tiles);

}  // namespace farhorizon

// The list of tiles as clients of CesiumJS read it. What it says is available has to be so, or they
// ask in vain: tiles are listed by rectangles, joined from runs, and not as one box a zoom.
#include "core/io/quantized_mesh/layer_json.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "core/base/result.h"

namespace farhorizon {

namespace {

using OrderedJson = nlohmann::ordered_json;

// The tiles of one zoom as rectangles: runs along x, joined over neighbouring runs that are alike.
OrderedJson RectanglesOf(std::vector<TileAddress> tiles) {
  struct Rectangle {
    std::int64_t start_x, start_y, end_x, end_y;
  };
  std::sort(tiles.begin(), tiles.end(), [](const TileAddress& a, const TileAddress& b) {
    return a.y != b.y ? a.y < b.y : a.x < b.x;
  });
  std::vector<Rectangle> runs;
  for (const TileAddress& tile : tiles) {
    if (!runs.empty() && runs.back().start_y == tile.y && runs.back().end_x + 1 == tile.x) {
      runs.back().end_x = tile.x;
    } else {
      runs.push_back({tile.x, tile.y, tile.x, tile.y});
    }
  }
  // A run takes the rectangle that ends a row further south at its columns.
  std::vector<Rectangle> joined;
  for (const Rectangle& run : runs) {
    const auto same = std::find_if(joined.begin(), joined.end(), [&run](const Rectangle& one) {
      return one.end_y + 1 == run.start_y && one.start_x == run.start_x && one.end_x == run.end_x;
    });
    if (same == joined.end()) {
      joined.push_back(run);
    } else {
      same->end_y = run.end_y;
    }
  }
  OrderedJson array = OrderedJson::array();
  for (const Rectangle& one : joined) {
    array.push_back({{"startX", one.start_x},
                     {"startY", one.start_y},
                     {"endX", one.end_x},
                     {"endY", one.end_y}});
  }
  return array;
}

// For each zoom from `first` on the rectangles of tiles.
OrderedJson AvailableFrom(int first, const std::vector<TileAddress>& tiles) {
  OrderedJson zooms = OrderedJson::array();
  for (int zoom = first; zoom <= tiles.back().zoom; ++zoom) {
    std::vector<TileAddress> here;
    std::copy_if(tiles.begin(), tiles.end(), std::back_inserter(here),
                 [zoom](const TileAddress& tile) { return tile.zoom == zoom; });
    zooms.push_back(RectanglesOf(std::move(here)));
  }
  return zooms;
}

}  // namespace

std::string TileName(const TileAddress& tile) {
  return "terrain-" + std::to_string(tile.zoom) + "-" + std::to_string(tile.x) + "-" +
         std::to_string(tile.y) + ".terrain";
}

std::string WriteLayerJson(const std::vector<TileAddress>& tiles) {
  Check(tiles.size() >= 2 && tiles[1].zoom == 0, "both tiles of zoom 0 are there");
  const int most = tiles.back().zoom;
  OrderedJson layer;
  layer["tilejson"] = "2.1.0";
  layer["name"] = "farhorizon";
  layer["version"] = "1.0.0";
  layer["format"] = "quantized-mesh-1.0";
  layer["scheme"] = "tms";
  layer["projection"] = "EPSG:4326";
  // Of the tiles that there are: those of zoom 0 cover the globe.
  layer["bounds"] = {-180, -90, 180, 90};
  layer["minzoom"] = 0;
  layer["maxzoom"] = most;
  layer["tiles"] = {"terrain-{z}-{x}-{y}.terrain"};
  layer["extensions"] = {"octvertexnormals", "metadata"};
  // Without it CesiumJS 1.145 fails on the first tile that has the metadata extension. Tiles whose
  // zoom it divides say what is available: with this one, those of zoom 0 alone.
  layer["metadataAvailability"] = most + 1;
  layer["available"] = AvailableFrom(0, tiles);
  return layer.dump(2) + "\n";
}

std::string MetadataOfTile(const TileAddress& tile, double geometric_error_m,
                           const std::vector<TileAddress>& tiles) {
  OrderedJson metadata;
  metadata["geometricerror"] = geometric_error_m;
  if (tile.zoom == 0) metadata["available"] = AvailableFrom(1, tiles);
  return metadata.dump();
}

}  // namespace farhorizon

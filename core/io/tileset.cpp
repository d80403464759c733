#include "core/io/tileset.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "core/base/result.h"

namespace farhorizon {

std::string WriteTileset(const std::vector<TilesetLevel>& levels, const BoundingRegion& region,
                         double root_error_m, const std::array<double, 16>& transform) {
  Check(!levels.empty(), "a tileset without levels");
  using Json = nlohmann::ordered_json;
  const Json volume = {{"region",
                        {region.west, region.south, region.east, region.north, region.min_height_m,
                         region.max_height_m}}};
  // Builds from the finest tile, the leaf, to the root. A coarser tile states at least the error of
  // the finer ones: clients refine while the error is too great, and would stop at a smaller one.
  Json tile;
  double error = 0;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    error = std::max(error, levels[i].geometric_error_m);
    Json around;
    if (i + 1 == levels.size()) around["transform"] = transform;
    around["boundingVolume"] = volume;
    around["geometricError"] = error;
    around["refine"] = "REPLACE";
    around["content"] = {{"uri", levels[i].uri}};
    if (i > 0) around["children"] = Json::array({std::move(tile)});
    tile = std::move(around);
  }
  Json tileset;
  tileset["asset"] = {{"version", "1.1"}};
  tileset["geometricError"] = std::max(error, root_error_m);
  tileset["root"] = std::move(tile);
  return tileset.dump(2) + "\n";
}

}  // namespace farhorizon

#include "core/io/tileset.h"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace farhorizon {

namespace {

using OrderedJson = nlohmann::ordered_json;

// A tile and all below it, as deep as there are levels. error_m: gets the tile's.
OrderedJson ToJson(const TilesetTile& tile, double& error_m) {
  error_m = tile.geometric_error_m;
  OrderedJson children = OrderedJson::array();
  for (const TilesetTile& child : tile.children) {
    double error_of_child_m = 0;
    children.push_back(ToJson(child, error_of_child_m));
    error_m = std::max(error_m, error_of_child_m);
  }
  const BoundingRegion& r = tile.region;
  OrderedJson json;
  json["boundingVolume"] = {
      {"region", {r.west, r.south, r.east, r.north, r.min_height_m, r.max_height_m}}};
  json["geometricError"] = error_m;
  json["refine"] = "REPLACE";
  if (!tile.uri.empty()) json["content"] = {{"uri", tile.uri}};
  if (!children.empty()) json["children"] = std::move(children);
  return json;
}

}  // namespace

std::string WriteTileset(const TilesetTile& root, double root_error_m,
                         const std::array<double, 16>& transform) {
  double error_m = 0;
  const OrderedJson tile = ToJson(root, error_m);
  OrderedJson tileset;
  tileset["asset"] = {{"version", "1.1"}};
  tileset["geometricError"] = std::max(error_m, root_error_m);
  tileset["root"]["transform"] = transform;
  tileset["root"].update(tile);
  return tileset.dump(2) + "\n";
}

}  // namespace farhorizon

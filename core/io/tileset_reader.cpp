#include "core/io/tileset_reader.h"

#include <utility>

#include <nlohmann/json.hpp>

namespace farhorizon {

namespace {

using Json = nlohmann::json;

Error BadTileset(const std::string& what) {
  return {ErrorCode::kUnsupportedData, "tileset.json: " + what, "bad-tileset"};
}

// A tile and all below it. Errors: "bad-tileset"; those of nlohmann::json are thrown.
Result<TilesetTile> ReadTile(const Json& json, int depth) {
  if (depth > kMostTilesDeep) {
    return BadTileset("tiles are more than " + std::to_string(kMostTilesDeep) + " deep");
  }
  TilesetTile tile;
  if (json.contains("content")) json.at("content").at("uri").get_to(tile.uri);
  json.at("geometricError").get_to(tile.geometric_error_m);
  const auto region = json.at("boundingVolume").at("region").get<std::array<double, 6>>();
  tile.region = {region[0], region[1], region[2], region[3], region[4], region[5]};
  for (const Json& child : json.value("children", Json::array())) {
    Result<TilesetTile> read = ReadTile(child, depth + 1);
    if (!read) return std::move(read.error());
    tile.children.push_back(*std::move(read));
  }
  return tile;
}

}  // namespace

Result<TilesetContents> ReadTileset(const std::string& text) {
  try {
    const auto json = Json::parse(text);
    TilesetContents contents;
    json.at("geometricError").get_to(contents.root_error_m);
    json.at("root").at("transform").get_to(contents.transform);
    Result<TilesetTile> root = ReadTile(json.at("root"), 1);
    if (!root) return std::move(root.error());
    contents.root = *std::move(root);
    return contents;
  } catch (const nlohmann::json::exception& failure) {
    return BadTileset(failure.what());
  }
}

}  // namespace farhorizon

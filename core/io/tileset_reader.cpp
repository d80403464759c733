#include "core/io/tileset_reader.h"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace farhorizon {

Result<TilesetContents> ReadTileset(const std::string& text) {
  try {
    const auto json = nlohmann::json::parse(text);
    TilesetContents contents;
    json.at("geometricError").get_to(contents.root_error_m);
    const nlohmann::json* tile = &json.at("root");
    tile->at("transform").get_to(contents.transform);
    // Each tile holds the next finer one.
    while (tile != nullptr) {
      contents.levels.push_back({tile->at("content").at("uri").get<std::string>(),
                                 tile->at("geometricError").get<double>()});
      const auto children = tile->find("children");
      if (children != tile->end() && children->size() != 1) {
        return Error{ErrorCode::kUnsupportedData, "tileset.json: a tile has not one child",
                     "bad-tileset"};
      }
      tile = children == tile->end() ? nullptr : &children->front();
    }
    std::reverse(contents.levels.begin(), contents.levels.end());
    return contents;
  } catch (const nlohmann::json::exception& failure) {
    return Error{ErrorCode::kUnsupportedData, std::string("tileset.json: ") + failure.what(),
                 "bad-tileset"};
  }
}

}  // namespace farhorizon

#include "core/io/quantized_mesh/layer_json.h"

#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace farhorizon {
namespace {

const std::vector<TileAddress> kTiles = {{0, 0, 0}, {0, 1, 0}, {1, 2, 1}, {2, 4, 2},
                                         {2, 4, 3}, {2, 5, 2}, {2, 5, 3}, {2, 7, 3}};

std::multiset<TileAddress> Listed(const nlohmann::json& available, int first) {
  std::multiset<TileAddress> tiles;
  int zoom = first;
  for (const auto& rectangles : available) {
    for (const auto& one : rectangles) {
      for (std::int64_t x = one["startX"]; x <= one["endX"].get<std::int64_t>(); ++x) {
        for (std::int64_t y = one["startY"]; y <= one["endY"].get<std::int64_t>(); ++y) {
          tiles.insert({zoom, x, y});
        }
      }
    }
    ++zoom;
  }
  return tiles;
}

TEST(LayerJson, ListsEachTileOnce) {
  const auto layer = nlohmann::json::parse(WriteLayerJson(kTiles));
  EXPECT_EQ(Listed(layer["available"], 0),
            std::multiset<TileAddress>(kTiles.begin(), kTiles.end()));
  EXPECT_EQ(layer["available"].size(), 3U);
  EXPECT_EQ(layer["available"][2].size(), 2U) << "a block of 2 x 2 tiles and a single one";
  EXPECT_EQ(layer["maxzoom"], 2);
}

TEST(LayerJson, SaysWhatClientsInsistOn) {
  const auto layer = nlohmann::json::parse(WriteLayerJson(kTiles));
  EXPECT_EQ(layer["format"], "quantized-mesh-1.0");
  EXPECT_EQ(layer["scheme"], "tms");
  EXPECT_EQ(layer["projection"], "EPSG:4326");
  ASSERT_EQ(layer["tiles"].size(), 1U);
  // What the template gives for a tile is the tile's file.
  std::string name = layer["tiles"][0];
  for (const auto& [key, value] :
       {std::pair("{z}", "2"), std::pair("{x}", "4"), std::pair("{y}", "3")}) {
    name.replace(name.find(key), 3, value);
  }
  EXPECT_EQ(name, TileName({2, 4, 3}));
}

TEST(LayerJson, TheTilesOfZoom0HaveTheOthersInTheirMetadata) {
  const auto layer = nlohmann::json::parse(WriteLayerJson(kTiles));
  EXPECT_GT(layer["metadataAvailability"], layer["maxzoom"]);
  const auto top = nlohmann::json::parse(MetadataOfTile({0, 1, 0}, 12.5, kTiles));
  EXPECT_EQ(top["geometricerror"], 12.5);
  EXPECT_EQ(Listed(top["available"], 1),
            std::multiset<TileAddress>(kTiles.begin() + 2, kTiles.end()));
  EXPECT_FALSE(nlohmann::json::parse(MetadataOfTile({1, 2, 1}, 1, {})).contains("available"));
}

}  // namespace
}  // namespace farhorizon

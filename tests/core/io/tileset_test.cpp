#include "core/io/tileset.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/io/tileset_reader.h"

namespace farhorizon {
namespace {

using Json = nlohmann::json;

constexpr BoundingRegion kRegion = {-1.47, 0.63, -1.46, 0.64, 200, 1100};
constexpr BoundingRegion kWest = {-1.47, 0.63, -1.465, 0.64, 200, 900};
constexpr std::array<double, 16> kTransform = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1};

TEST(WriteTileset, NestsTilesFromTheRootToTheLeaves) {
  const TilesetTile root = {
      "lod1.glb",
      30,
      kRegion,
      {{"lod0-0-0.glb", 0.25, kWest, {}}, {"lod0-1-0.glb", 0.5, kRegion, {}}}};
  const Json tileset = Json::parse(WriteTileset(root, 40000, kTransform));
  EXPECT_EQ(tileset["asset"]["version"], "1.1");
  EXPECT_EQ(tileset["geometricError"], 40000);
  const Json& tile = tileset["root"];
  EXPECT_EQ(tile["content"]["uri"], "lod1.glb");
  EXPECT_EQ(tile["geometricError"], 30);
  EXPECT_EQ(tile["refine"], "REPLACE");
  EXPECT_EQ(tile["transform"].get<std::vector<double>>()[12], 5);
  EXPECT_EQ(tile["boundingVolume"]["region"],
            Json::array({-1.47, 0.63, -1.46, 0.64, 200.0, 1100.0}));
  ASSERT_EQ(tile["children"].size(), 2U);
  const Json& leaf = tile["children"][0];
  EXPECT_EQ(leaf["content"]["uri"], "lod0-0-0.glb");
  EXPECT_EQ(leaf["geometricError"], 0.25);
  EXPECT_EQ(leaf["boundingVolume"]["region"][2], -1.465);
  EXPECT_FALSE(leaf.contains("transform"));  // the root's applies to all
  EXPECT_FALSE(leaf.contains("children"));
}

TEST(WriteTileset, ErrorsNeverFallTowardsTheRoot) {
  const TilesetTile root = {
      "lod2.glb", 2, kRegion, {{"lod1.glb", 3, kRegion, {{"lod0.glb", 5, kRegion, {}}}}}};
  const Json tileset = Json::parse(WriteTileset(root, 4, kTransform));
  EXPECT_EQ(tileset["geometricError"], 5);
  EXPECT_EQ(tileset["root"]["geometricError"], 5);
  EXPECT_EQ(tileset["root"]["children"][0]["geometricError"], 5);
}

TEST(WriteTileset, ARootWithoutContentHasNone) {
  const TilesetTile root = {"", 9, kRegion, {{"lod0-0-0.glb", 1, kWest, {}}}};
  const Json tileset = Json::parse(WriteTileset(root, 9, kTransform));
  EXPECT_FALSE(tileset["root"].contains("content"));
  EXPECT_EQ(tileset["root"]["geometricError"], 9);
}

TEST(ReadTileset, ReadsNumbersBackExactly) {
  std::array<double, 16> transform = kTransform;
  transform[13] = -4748231.123456789;
  const TilesetTile root = {"", 9, kRegion, {{"lod0-0-0.glb", 0.1 + 0.2, kWest, {}}}};
  const Result<TilesetContents> read = ReadTileset(WriteTileset(root, 9, transform));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->transform, transform);
  EXPECT_EQ(read->root.uri, "");
  ASSERT_EQ(read->root.children.size(), 1U);
  const TilesetTile& child = read->root.children[0];
  EXPECT_EQ(child.uri, "lod0-0-0.glb");
  EXPECT_EQ(child.geometric_error_m, 0.1 + 0.2);
  EXPECT_EQ(child.region.east, kWest.east);
  EXPECT_EQ(child.region.max_height_m, kWest.max_height_m);
}

TEST(ReadTileset, RefusesTilesBelowOneAnotherWithoutEnd) {
  TilesetTile tile = {"lod0.glb", 1, kRegion, {}};
  for (int i = 1; i < kMostTilesDeep; ++i) tile = {"lod0.glb", 1, kRegion, {tile}};
  EXPECT_TRUE(ReadTileset(WriteTileset(tile, 1, kTransform)));
  tile = {"lod0.glb", 1, kRegion, {tile}};
  EXPECT_FALSE(ReadTileset(WriteTileset(tile, 1, kTransform)));
  EXPECT_FALSE(ReadTileset("{}"));
}

}  // namespace
}  // namespace farhorizon

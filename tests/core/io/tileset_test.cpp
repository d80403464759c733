#include "core/io/tileset.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace farhorizon {
namespace {

using Json = nlohmann::json;

constexpr BoundingRegion kRegion = {-1.47, 0.63, -1.46, 0.64, 200, 1100};
constexpr std::array<double, 16> kTransform = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1};

TEST(WriteTileset, NestsTheLevelsFromTheCoarsestRootToTheFinestLeaf) {
  const Json tileset = Json::parse(WriteTileset(
      {{"lod0.glb", 0.25}, {"lod1.glb", 8}, {"lod2.glb", 30}}, kRegion, 40000, kTransform));
  EXPECT_EQ(tileset["asset"]["version"], "1.1");
  EXPECT_EQ(tileset["geometricError"], 40000);
  const Json& root = tileset["root"];
  EXPECT_EQ(root["content"]["uri"], "lod2.glb");
  EXPECT_EQ(root["geometricError"], 30);
  EXPECT_EQ(root["refine"], "REPLACE");
  EXPECT_EQ(root["transform"].get<std::vector<double>>()[12], 5);
  EXPECT_EQ(root["boundingVolume"]["region"],
            Json::array({-1.47, 0.63, -1.46, 0.64, 200.0, 1100.0}));
  const Json& middle = root["children"][0];
  EXPECT_EQ(middle["content"]["uri"], "lod1.glb");
  EXPECT_FALSE(middle.contains("transform"));  // the root's applies to all
  const Json& leaf = middle["children"][0];
  EXPECT_EQ(leaf["content"]["uri"], "lod0.glb");
  EXPECT_EQ(leaf["geometricError"], 0.25);
  EXPECT_FALSE(leaf.contains("children"));
}

TEST(WriteTileset, ErrorsNeverFallTowardsTheRoot) {
  const Json tileset = Json::parse(
      WriteTileset({{"lod0.glb", 5}, {"lod1.glb", 2}, {"lod2.glb", 7}}, kRegion, 6, kTransform));
  EXPECT_EQ(tileset["geometricError"], 7);
  EXPECT_EQ(tileset["root"]["geometricError"], 7);
  EXPECT_EQ(tileset["root"]["children"][0]["geometricError"], 5);
  EXPECT_EQ(tileset["root"]["children"][0]["children"][0]["geometricError"], 5);
}

TEST(WriteTileset, NumbersReadBackExactly) {
  std::array<double, 16> transform = kTransform;
  transform[13] = -4748231.123456789;
  const Json tileset = Json::parse(WriteTileset({{"lod0.glb", 0.1 + 0.2}}, kRegion, 1, transform));
  EXPECT_EQ(tileset["root"]["transform"][13].get<double>(), -4748231.123456789);
  EXPECT_EQ(tileset["root"]["geometricError"].get<double>(), 0.1 + 0.2);
}

}  // namespace
}  // namespace farhorizon

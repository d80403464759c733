#include "core/io/mesh_files/tileset_tiles.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

using testing::HasSubstr;
using Json = nlohmann::json;

Json Tileset(const Json& root) {
  return {{"asset", {{"version", "1.1"}}}, {"geometricError", 100}, {"root", root}};
}

Json Moved(double x, double y, double z) {
  return {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, x, y, z, 1};
}

class ReadTilesTest : public testing::Test {
 protected:
  Result<std::vector<TileContent>> Read(const Json& root) {
    SpillFile(folder_ / "tileset.json", Tileset(root).dump());
    return ReadTiles(folder_ / "tileset.json");
  }
  std::string Complaint(const Json& root) {
    const auto tiles = Read(root);
    return tiles ? "it is read" : tiles.error().message;
  }

  TempDir folder_;
};

TEST_F(ReadTilesTest, MultipliesTransformsDownTheTreeAndCountsContentAbove) {
  const auto tiles = Read({{"transform", Moved(1, 0, 0)},
                           {"geometricError", 50},
                           {"children",
                            {{{"content", {{"uri", "a.glb"}}},
                              {"geometricError", 20},
                              {"children",
                               {{{"transform", Moved(0, 2, 0)},
                                 {"contents", {{{"uri", "b.glb"}}, {{"uri", "sub/c.glb?v=1"}}}}}}}},
                             {{"content", {{"url", "d.glb"}}}}}}});
  ASSERT_TRUE(tiles) << tiles.error().message;
  ASSERT_EQ(tiles->size(), 4U);
  const auto& [a, b, c, d] = std::tie((*tiles)[0], (*tiles)[1], (*tiles)[2], (*tiles)[3]);
  EXPECT_EQ(a.uri, "a.glb");
  EXPECT_EQ(a.geometric_error_m, 20);
  EXPECT_EQ(a.depth, 0);
  EXPECT_EQ(b.depth, 1);
  EXPECT_EQ(c.file, folder_.path() / "sub" / "c.glb");
  EXPECT_EQ(d.depth, 0);
  // glTF's y is up, its z south.
  EXPECT_EQ(Apply(a.placing, {10, 20, 30}), (FilePoint{11, -30, 20}));
  EXPECT_EQ(Apply(b.placing, {10, 20, 30}), (FilePoint{11, -28, 20}));
}

TEST_F(ReadTilesTest, FollowsTilesetsBelowOnce) {
  SpillFile(folder_ / "below.json",
            Tileset({{"transform", Moved(0, 0, 5)}, {"content", {{"uri", "fine.glb"}}}}).dump());
  const auto tiles = Read({{"content", {{"uri", "coarse.glb"}}},
                           {"transform", Moved(1, 0, 0)},
                           {"children", {{{"content", {{"uri", "below.json"}}}}}}});
  ASSERT_TRUE(tiles) << tiles.error().message;
  ASSERT_EQ(tiles->size(), 2U);
  EXPECT_EQ((*tiles)[1].uri, "fine.glb");
  EXPECT_EQ((*tiles)[1].depth, 1);
  EXPECT_EQ(Apply((*tiles)[1].placing, {0, 0, 0}), (FilePoint{1, 0, 5}));
  EXPECT_THAT(Complaint({{"content", {{"uri", "tileset.json"}}}}), HasSubstr("named twice"));
}

TEST_F(ReadTilesTest, RefusesWhatItCannotRead) {
  EXPECT_THAT(Complaint({{"content", {{"uri", "../a.glb"}}}}), HasSubstr("beside"));
  EXPECT_THAT(Complaint({{"content", {{"uri", "http://a/b.glb"}}}}), HasSubstr("beside"));
  EXPECT_THAT(Complaint({{"implicitTiling", Json::object()}}), HasSubstr("implicit"));
  EXPECT_THAT(Complaint({{"content", {{"uri", 7}}}}), HasSubstr("not as 3D Tiles has it"));
  EXPECT_THAT(Complaint({{"transform", {1, 2}}}), HasSubstr("not as 3D Tiles has it"));
  EXPECT_THAT(Complaint(Json::object()), HasSubstr("no tile"));
  Json many = Json::array();
  for (int i = 0; i < 5000; ++i) many.push_back({{"content", {{"uri", "a.glb"}}}});
  EXPECT_THAT(Complaint({{"children", many}}), HasSubstr("more than 4096"));
}

}  // namespace
}  // namespace farhorizon

#include "core/io/horizon_glb.h"

#include <bit>
#include <cstring>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/io/glb.h"

namespace farhorizon {
namespace {

using Json = nlohmann::json;

const QuantizationLattice kLattice = {{100, -200, 300}, 0.25, 19};

// An edge of the DEM, a chord, and one without measures.
std::vector<HorizonLine> SomeLines() {
  return {{{{{0, 5, 524287}, {7, 5, 3}}}, {1, 2}, 0x8000000100000003U, 1.5F, 0.25F},
          {{{{7, 5, 3}, {9, 9, 9}}}, {2, 4'000'000'000U}, 0xffU, std::nullopt, std::nullopt},
          {{{{1, 1, 1}, {2, 2, 2}}}, {7, 8}, 0, 0.0F, std::nullopt}};
}

std::uint32_t Number(const std::vector<std::uint8_t>& bytes, std::size_t at) {
  std::uint32_t number = 0;
  std::memcpy(&number, &bytes[at], sizeof number);
  return number;
}

Json JsonOf(const std::vector<std::uint8_t>& glb) {
  return Json::parse(glb.begin() + 20, glb.begin() + 20 + Number(glb, 12));
}

TEST(HorizonGlb, ReadsBackWhatItWrote) {
  const std::vector<std::uint8_t> glb = WriteHorizonGlb(SomeLines(), kLattice);
  EXPECT_EQ(glb, WriteHorizonGlb(SomeLines(), kLattice));
  Result<HorizonGlbContents> read = ReadHorizonGlb(glb);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->lines, SomeLines());
  EXPECT_EQ(read->matrix, GltfMatrix(kLattice));
  EXPECT_TRUE(read->has_table);
  EXPECT_TRUE(read->in_box);
}

TEST(HorizonGlb, ViewsBeginAtMultiplesOfEightInTheFile) {
  const std::vector<std::uint8_t> glb = WriteHorizonGlb(SomeLines(), kLattice);
  const std::size_t buffer = 20 + Number(glb, 12) + 8;
  EXPECT_EQ(buffer % 8, 0U);
  EXPECT_EQ(Number(glb, 8), glb.size());
  const Json gltf = JsonOf(glb);
  EXPECT_EQ(gltf["bufferViews"].size(), 6U);
  for (const Json& view : gltf["bufferViews"]) {
    EXPECT_EQ(view["byteOffset"].get<std::size_t>() % 8, 0U);
  }
  // The chunk may be no more than three bytes longer than the buffer.
  EXPECT_EQ(Number(glb, buffer - 8), gltf["buffers"][0]["byteLength"]);
}

TEST(HorizonGlb, IsLinesWithAFeatureForEach) {
  const std::vector<std::uint8_t> glb = WriteHorizonGlb(SomeLines(), kLattice);
  const Json gltf = JsonOf(glb);
  const Json& primitive = gltf["meshes"][0]["primitives"][0];
  EXPECT_EQ(primitive["mode"], 1);
  EXPECT_FALSE(primitive.contains("indices"));
  const Json& position = gltf["accessors"][0];
  EXPECT_EQ(position["count"], 6);
  EXPECT_EQ(position["min"], Json::array({0, 1, 1}));
  EXPECT_EQ(position["max"], Json::array({9, 9, 524287}));
  const Json& id = primitive["extensions"]["EXT_mesh_features"]["featureIds"][0];
  EXPECT_EQ(id["featureCount"], 3);
  EXPECT_EQ(primitive["attributes"]["_FEATURE_ID_" + id["attribute"].dump()], 1);
  const std::size_t ids =
      20 + Number(glb, 12) + 8 + gltf["bufferViews"][1]["byteOffset"].get<std::size_t>();
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(std::bit_cast<float>(Number(glb, ids + 4 * i)), static_cast<float>(i / 2));
  }
  EXPECT_EQ(gltf["extensionsUsed"].size(), 3U);
  EXPECT_FALSE(gltf.contains("extensionsRequired"));  // any client draws the lines
}

TEST(HorizonGlb, TheTableHasARowForEachLine) {
  const std::vector<std::uint8_t> glb = WriteHorizonGlb(SomeLines(), kLattice);
  const Json gltf = JsonOf(glb);
  const Json& metadata = gltf["extensions"]["EXT_structural_metadata"];
  const Json& table = metadata["propertyTables"][0];
  EXPECT_EQ(table["count"], 3);
  const Json& properties = metadata["schema"]["classes"][table["class"].get<std::string>()];
  EXPECT_EQ(properties["properties"].size(), 4U);
  for (const auto& [name, property] : table["properties"].items()) {
    const Json& described = properties["properties"][name];
    const std::size_t width = described["type"] == "VEC2" ? 8 : 4;
    EXPECT_EQ(gltf["bufferViews"][property["values"].get<std::size_t>()]["byteLength"], 3 * width);
    EXPECT_EQ(described["required"], !described.contains("noData")) << name;
  }
}

TEST(HorizonGlb, OtherBytesAreAnErrorWithACause) {
  const std::vector<std::uint8_t> whole = WriteHorizonGlb(SomeLines(), kLattice);
  for (std::size_t size = 0; size < whole.size(); size += 41) {
    EXPECT_FALSE(
        ReadHorizonGlb({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)}));
  }
  const auto changed = [&](const std::string& what, const std::string& with) {
    std::string text(whole.begin(), whole.end());
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    text.replace(at, with.size(), with);
    return ReadHorizonGlb({text.begin(), text.end()});
  };
  EXPECT_FALSE(changed(R"("mode":1)", R"("mode":4)"));
  EXPECT_FALSE(changed(R"("count":6)", R"("count":8)"));
  EXPECT_FALSE(changed(R"("count":6)", R"("count":5)"));
  EXPECT_FALSE(changed(R"("byteOffset":0)", R"("byteOffset":9)"));
  EXPECT_FALSE(changed(R"("count":3)", R"("count":2)"));
  Result<HorizonGlbContents> outside = changed("[9.0,9.0,", "[8.0,9.0,");
  ASSERT_TRUE(outside);
  EXPECT_FALSE(outside->in_box);
}

}  // namespace
}  // namespace farhorizon

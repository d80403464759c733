#include "core/io/horizon_glb.h"

#include <cstring>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/io/glb.h"
#include "core/io/horizon_glb_reader.h"

namespace farhorizon {
namespace {

using Json = nlohmann::json;

const QuantizationLattice kLattice = {{100, -200, 300}, 0.25, 19};

// Two edges of the DEM, a chord that leaves the point between them, and a ring without a drop.
std::vector<LineChain> SomeChains(float highest = 65535) {
  return {{{{0, 5, highest}, {7, 5, 3}, {9, 9, 9}}, 0x8000000100000003U, 1.5F, 0.25F},
          {{{7, 5, 3}, {9, 1, 9}}, 0xffU, std::nullopt, std::nullopt},
          {{{1, 1, 1}, {2, 2, 2}, {3, 1, 1}, {1, 1, 1}}, 0, 0.0F, std::nullopt}};
}

std::uint32_t NumberAt(const std::vector<std::uint8_t>& bytes, std::size_t at) {
  std::uint32_t number = 0;
  std::memcpy(&number, &bytes[at], sizeof number);
  return number;
}

Json GltfOf(const std::vector<std::uint8_t>& glb) {
  return Json::parse(glb.begin() + 20, glb.begin() + 20 + NumberAt(glb, 12));
}

TEST(HorizonGlb, ReadsBackWhatItWrote) {
  for (const float highest : {65535.0F, 65536.0F}) {
    const std::vector<LineChain> chains = SomeChains(highest);
    const std::vector<std::uint8_t> glb = WriteHorizonGlb(chains, kLattice);
    EXPECT_EQ(glb, WriteHorizonGlb(chains, kLattice));
    Result<HorizonGlbContents> read = ReadHorizonGlb(glb);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->chains, chains);
    EXPECT_EQ(read->matrix, GltfMatrix(kLattice));
    EXPECT_TRUE(read->in_box);
  }
}

TEST(HorizonGlb, ViewsBeginAtMultiplesOfEightInTheFile) {
  const std::vector<std::uint8_t> glb = WriteHorizonGlb(SomeChains(), kLattice);
  const std::size_t buffer = 20 + NumberAt(glb, 12) + 8;
  EXPECT_EQ(buffer % 8, 0U);
  EXPECT_EQ(NumberAt(glb, 8), glb.size());
  const Json gltf = GltfOf(glb);
  EXPECT_EQ(gltf["bufferViews"].size(), 6U);
  for (const Json& view : gltf["bufferViews"]) {
    EXPECT_EQ(view["byteOffset"].get<std::size_t>() % 8, 0U);
  }
  // The chunk may be no more than three bytes longer than the buffer.
  EXPECT_EQ(NumberAt(glb, buffer - 8), gltf["buffers"][0]["byteLength"]);
}

TEST(HorizonGlb, IsIndexedLinesWithEachPointOnce) {
  const Json gltf = GltfOf(WriteHorizonGlb(SomeChains(), kLattice));
  const Json& primitive = gltf["meshes"][0]["primitives"][0];
  EXPECT_EQ(primitive["mode"], 1);
  const Json& position = gltf["accessors"][0];
  EXPECT_EQ(position["count"], 7);
  EXPECT_EQ(position["min"], Json::array({0, 1, 1}));
  EXPECT_EQ(position["max"], Json::array({9, 9, 65535}));
  EXPECT_EQ(gltf["accessors"][primitive["indices"].get<std::size_t>()]["count"], 12);
}

TEST(HorizonGlb, NumbersAreOfSixteenBitsWhereAllFit) {
  const Json quantized = GltfOf(WriteHorizonGlb(SomeChains(65535), kLattice));
  EXPECT_EQ(quantized["accessors"][0]["componentType"], 5123);
  EXPECT_EQ(quantized["bufferViews"][0]["byteStride"], 8);
  EXPECT_EQ(quantized["extensionsRequired"], Json::array({"KHR_mesh_quantization"}));
  const Json floats = GltfOf(WriteHorizonGlb(SomeChains(65536), kLattice));
  EXPECT_EQ(floats["accessors"][0]["componentType"], 5126);
  EXPECT_FALSE(floats.contains("extensionsRequired"));
}

TEST(HorizonGlb, IndicesGrowWhereSixteenBitsDoNotNameAllPoints) {
  LineChain chain;
  for (int i = 0; i < 65536; ++i) chain.points.push_back({static_cast<float>(i), 0, 0});
  const std::vector<LineChain> chains = {chain};
  const std::vector<std::uint8_t> glb = WriteHorizonGlb(chains, kLattice);
  EXPECT_EQ(GltfOf(glb)["accessors"][1]["componentType"], 5125);
  Result<HorizonGlbContents> read = ReadHorizonGlb(glb);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->chains, chains);
}

TEST(HorizonGlb, TheTableHasARowForEachChain) {
  const Json gltf = GltfOf(WriteHorizonGlb(SomeChains(), kLattice));
  const Json& metadata = gltf["extensions"]["EXT_structural_metadata"];
  const Json& table = metadata["propertyTables"][0];
  EXPECT_EQ(table["count"], 3);
  const Json& properties = metadata["schema"]["classes"][table["class"].get<std::string>()];
  EXPECT_EQ(properties["properties"].size(), 4U);
  const auto length = [&](const char* name) {
    const auto view = table["properties"][name]["values"].get<std::size_t>();
    return gltf["bufferViews"][view]["byteLength"].get<int>();
  };
  EXPECT_EQ(length("edges"), 3 * 1);
  EXPECT_EQ(length("azimuths"), 3 * 8);
  EXPECT_EQ(length("line_measure_m"), 3 * 4);
  EXPECT_EQ(length("skyline_drop_m"), 3 * 4);
  for (const auto& [name, property] : properties["properties"].items()) {
    EXPECT_NE(property.value("required", false), property.contains("noData")) << name;
  }
}

TEST(HorizonGlb, OtherBytesAreAnErrorWithACause) {
  const std::vector<std::uint8_t> whole = WriteHorizonGlb(SomeChains(), kLattice);
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
  EXPECT_FALSE(changed(R"("count":7)", R"("count":6)"));
  EXPECT_FALSE(changed(R"("count":12)", R"("count":10)"));
  EXPECT_FALSE(changed(R"("count":3)", R"("count":2)"));
  EXPECT_FALSE(changed(R"("byteOffset":0)", R"("byteOffset":9)"));
  EXPECT_FALSE(changed(R"("componentType":5123)", R"("componentType":5120)"));
  Result<HorizonGlbContents> outside = changed("[9,9,65535]", "[8,9,65535]");
  ASSERT_TRUE(outside);
  EXPECT_FALSE(outside->in_box);
}

// What its lines are, where the table counts them wrongly or an index names no point.
TEST(HorizonGlb, LinesThatAreNoChainsAreAnError) {
  std::vector<std::uint8_t> glb = WriteHorizonGlb(SomeChains(), kLattice);
  const Json gltf = GltfOf(glb);
  const std::size_t buffer = 20 + NumberAt(glb, 12) + 8;
  const auto with = [&](std::size_t view, std::size_t byte, std::uint8_t value) {
    std::vector<std::uint8_t> other = glb;
    other[buffer + gltf["bufferViews"][view]["byteOffset"].get<std::size_t>() + byte] = value;
    return ReadHorizonGlb(other);
  };
  EXPECT_TRUE(with(1, 0, 0));   // as it is
  EXPECT_FALSE(with(1, 0, 7));  // there are seven points
  EXPECT_FALSE(with(1, 4, 0));  // the second edge does not begin where the first one ends
  EXPECT_FALSE(with(2, 0, 3));  // a chain of three edges, two of which hang together
  EXPECT_FALSE(with(2, 2, 4));  // more edges than there are
  EXPECT_FALSE(with(2, 2, 2));  // fewer
}

}  // namespace
}  // namespace farhorizon

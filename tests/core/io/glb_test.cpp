#include "core/io/glb.h"

#include <draco/compression/decode.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/local_meshes.h"

namespace farhorizon {
namespace {

using Json = nlohmann::json;
using VertexPairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

struct Encoded {
  std::vector<std::uint8_t> draco;
  DecodedMesh decoded;
};

Encoded Encode(std::uint32_t columns, std::uint32_t rows) {
  const LocalMesh mesh = HillyGrid(columns, rows, 10);
  Encoded encoded;
  encoded.draco = *EncodeDraco(mesh, ChooseLattice(mesh.positions, 0.25));
  encoded.decoded = *DecodeDraco(encoded.draco);
  return encoded;
}

std::uint32_t Number(const std::vector<std::uint8_t>& bytes, std::size_t at) {
  return bytes[at] | bytes[at + 1] << 8U | bytes[at + 2] << 16U |
         static_cast<std::uint32_t>(bytes[at + 3]) << 24U;
}

Json JsonOfGlb(const std::vector<std::uint8_t>& glb) {
  return Json::parse(glb.begin() + 20, glb.begin() + 20 + Number(glb, 12));
}

// The first inner edge of a triangle of `mesh`, so that it has a neighbour.
VertexPairs SomeEdges(const LocalMesh& mesh) {
  VertexPairs edges;
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 7) {
    edges.emplace_back(mesh.triangles[i][0], mesh.triangles[i][1]);
  }
  return edges;
}

TEST(Glb, ChunksAreAlignedAndTheHeaderTellsTheLength) {
  const Encoded e = Encode(9, 8);
  const std::vector<std::uint8_t> glb =
      WriteGlb(e.draco, e.decoded, FlagEdges(e.decoded.mesh, SomeEdges(e.decoded.mesh)));
  EXPECT_EQ(Number(glb, 0), 0x46546C67U);
  EXPECT_EQ(Number(glb, 4), 2U);
  EXPECT_EQ(Number(glb, 8), glb.size());
  EXPECT_EQ(Number(glb, 12) % 4, 0U);
  EXPECT_EQ(Number(glb, 16), 0x4E4F534AU);
  const std::size_t bin = 20 + Number(glb, 12);
  EXPECT_EQ(Number(glb, bin) % 4, 0U);
  EXPECT_EQ(Number(glb, bin + 4), 0x004E4942U);
  EXPECT_EQ(bin + 8 + Number(glb, bin), glb.size());
}

TEST(Glb, DracoAccessorsHaveNoViewAndTellOfTheDecodedMesh) {
  const Encoded e = Encode(9, 8);
  const Json gltf = JsonOfGlb(WriteGlb(e.draco, e.decoded, {}));
  const Json& primitive = gltf["meshes"][0]["primitives"][0];
  const Json& position = gltf["accessors"][primitive["attributes"]["POSITION"].get<int>()];
  const Json& indices = gltf["accessors"][primitive["indices"].get<int>()];
  EXPECT_FALSE(position.contains("bufferView"));
  EXPECT_FALSE(position.contains("byteOffset"));
  EXPECT_FALSE(indices.contains("bufferView"));
  EXPECT_EQ(position["count"], 72);
  EXPECT_EQ(indices["count"], 3 * 2 * 8 * 7);
  EXPECT_EQ(indices["componentType"], 5123);
  for (const Enu& p : e.decoded.mesh.positions) {
    const double up = (p.up - e.decoded.lattice.origin[2]) / 0.25;  // in lattice numbers
    EXPECT_LE(position["min"][2].get<double>(), up);
    EXPECT_GE(position["max"][2].get<double>(), up);
  }
  const Json& normal = gltf["accessors"][primitive["attributes"]["NORMAL"].get<int>()];
  EXPECT_EQ(normal["count"], 72);
  EXPECT_EQ(normal["type"], "VEC3");
  EXPECT_EQ(normal["componentType"], 5126);
  EXPECT_FALSE(normal.contains("bufferView"));
  EXPECT_EQ(primitive["extensions"]["KHR_draco_mesh_compression"]["attributes"]["NORMAL"], 2);
  EXPECT_EQ(gltf["extensionsRequired"], Json::array({"KHR_draco_mesh_compression"}));
  EXPECT_EQ(primitive["extensions"]["KHR_draco_mesh_compression"]["attributes"]["POSITION"], 0);
  EXPECT_EQ(primitive["mode"], 4);
}

TEST(Glb, TheNodePlacesLatticeNumbersAndTurnsZUpToYUp) {
  const Encoded e = Encode(30, 20);
  const Json gltf = JsonOfGlb(WriteGlb(e.draco, e.decoded, {}));
  const auto m = gltf["nodes"][0]["matrix"].get<std::vector<double>>();
  ASSERT_EQ(m.size(), 16U);
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(e.draco.data()), e.draco.size());
  draco::Decoder decoder;
  const auto mesh = std::move(decoder.DecodeMeshFromBuffer(&buffer)).value();
  // What a client does: Draco's positions through the matrix, in floats as a renderer has them.
  for (std::uint32_t i = 0; i < mesh->num_points(); ++i) {
    std::array<float, 3> p{};
    mesh->GetAttributeByUniqueId(0)->GetMappedValue(draco::PointIndex(i), p.data());
    std::array<float, 3> placed{};
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t k = 0; k < 3; ++k) placed[row] += static_cast<float>(m[4 * k + row]) * p[k];
      placed[row] += static_cast<float>(m[12 + row]);
    }
    const Enu& there = e.decoded.mesh.positions[i];
    EXPECT_EQ(placed[0], there.east);    // east stays right
    EXPECT_EQ(placed[1], there.up);      // up is glTF's y
    EXPECT_EQ(placed[2], -there.north);  // north is away
  }
}

TEST(Glb, MoreVerticesThanShortsCanNameTakeLongIndices) {
  const Encoded e = Encode(300, 220);
  EXPECT_EQ(JsonOfGlb(WriteGlb(e.draco, e.decoded, {}))["accessors"][1]["componentType"], 5125);
}

TEST(Glb, HorizonEdgesAreInTheExtensionAndOnlyThen) {
  const Encoded e = Encode(9, 8);
  Json gltf = JsonOfGlb(WriteGlb(e.draco, e.decoded, {}));
  EXPECT_EQ(gltf["extensionsUsed"], Json::array({"KHR_draco_mesh_compression"}));
  const std::vector<std::uint8_t> glb =
      WriteGlb(e.draco, e.decoded, FlagEdges(e.decoded.mesh, SomeEdges(e.decoded.mesh)));
  gltf = JsonOfGlb(glb);
  EXPECT_EQ(gltf["extensionsUsed"][1], "EXT_mesh_primitive_edge_visibility");
  const Json& edges =
      gltf["meshes"][0]["primitives"][0]["extensions"]["EXT_mesh_primitive_edge_visibility"];
  const Json& visibility = gltf["accessors"][edges["visibility"].get<int>()];
  EXPECT_EQ(visibility["count"], (6 * 2 * 8 * 7 + 7) / 8);
  const Json& view = gltf["bufferViews"][visibility["bufferView"].get<int>()];
  const std::size_t start = 20 + Number(glb, 12) + 8 + view["byteOffset"].get<std::size_t>();
  int silhouettes = 0;
  for (std::size_t i = 0; i < 4 * visibility["count"].get<std::size_t>(); ++i) {
    silhouettes += (glb[start + i / 4] >> (2 * (i % 4)) & 3) == 1 ? 1 : 0;
  }
  EXPECT_GT(silhouettes, 3);
  EXPECT_EQ(gltf["accessors"][edges["silhouetteNormals"].get<int>()]["count"], 2 * silhouettes);
}

TEST(Glb, ReadsBackTheEdgesThatItFlagged) {
  const Encoded e = Encode(9, 8);
  const VertexPairs edges = SomeEdges(e.decoded.mesh);
  Result<GlbContents> contents =
      ReadGlb(WriteGlb(e.draco, e.decoded, FlagEdges(e.decoded.mesh, edges)));
  ASSERT_TRUE(contents);
  EdgeVisibility flagged = FlagEdges(e.decoded.mesh, edges);
  EXPECT_GT(flagged.edge_count, 0);
  flagged.edge_count = 0;  // not in the file
  EXPECT_EQ(contents->edges, flagged);
  EXPECT_TRUE(ReadGlb(WriteGlb(e.draco, e.decoded, {}))->edges.bits.empty());
}

TEST(Glb, ReadsBackWhatItWrote) {
  const Encoded e = Encode(9, 8);
  Result<GlbContents> contents =
      ReadGlb(WriteGlb(e.draco, e.decoded, FlagEdges(e.decoded.mesh, SomeEdges(e.decoded.mesh))));
  ASSERT_TRUE(contents) << contents.error().message;
  EXPECT_EQ(contents->surface.draco, e.draco);
  EXPECT_EQ(contents->surface.vertex_count, 72);
  EXPECT_EQ(contents->surface.normal_count, 72);
  EXPECT_EQ(contents->matrix, GltfMatrix(e.decoded.lattice));
  EXPECT_EQ(contents->surface.index_count, 3 * 2 * 8 * 7);
  EXPECT_LT(contents->surface.min[0], contents->surface.max[0]);
}

TEST(Glb, TheSkirtIsASecondPrimitiveOfTheSameMeshAndMaterial) {
  const Encoded e = Encode(9, 8);
  const Encoded small = Encode(4, 3);
  const EncodedMesh skirt = {small.draco, small.decoded};
  const std::vector<std::uint8_t> glb =
      WriteGlb(e.draco, e.decoded, FlagEdges(e.decoded.mesh, SomeEdges(e.decoded.mesh)), &skirt);
  const Json primitives = JsonOfGlb(glb)["meshes"][0]["primitives"];
  ASSERT_EQ(primitives.size(), 2U);
  EXPECT_FALSE(primitives[0].contains("extras"));
  EXPECT_EQ(primitives[1]["extras"], Json({{"skirt", true}}));
  EXPECT_EQ(primitives[1]["material"], primitives[0]["material"]);
  EXPECT_FALSE(primitives[1]["extensions"].contains("EXT_mesh_primitive_edge_visibility"));
  const Result<GlbContents> contents = ReadGlb(glb);
  ASSERT_TRUE(contents) << contents.error().message;
  EXPECT_EQ(contents->surface.draco, e.draco);
  ASSERT_TRUE(contents->skirt);
  EXPECT_EQ(contents->skirt->draco, small.draco);
  EXPECT_EQ(contents->skirt->vertex_count, 12);
  EXPECT_EQ(contents->skirt->index_count, 3 * 2 * 3 * 2);
}

TEST(Glb, ReadingACutOrDamagedFileFailsWithAReason) {
  const Encoded e = Encode(9, 8);
  const std::vector<std::uint8_t> glb =
      WriteGlb(e.draco, e.decoded, FlagEdges(e.decoded.mesh, SomeEdges(e.decoded.mesh)));
  for (std::size_t size = 0; size < glb.size(); size += 13) {
    Result<GlbContents> cut =
        ReadGlb({glb.begin(), glb.begin() + static_cast<std::ptrdiff_t>(size)});
    ASSERT_FALSE(cut);
    EXPECT_EQ(cut.error().kind, "bad-glb");
  }
  for (std::size_t at = 8; at < 20 + Number(glb, 12); ++at) {
    std::vector<std::uint8_t> damaged = glb;
    damaged[at] ^= 0x15;
    static_cast<void>(ReadGlb(damaged));  // may succeed; must not crash
  }
}

}  // namespace
}  // namespace farhorizon

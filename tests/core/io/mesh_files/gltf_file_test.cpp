#include "core/io/mesh_files/gltf_file.h"

#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/mesh_matchers.h"
#include "tests/support/mesh_writers.h"
#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

using testing::HasSubstr;
using Json = nlohmann::json;

PlainMesh SomeHills() {
  return GridMeshOf(4, 3, [](std::uint32_t c, std::uint32_t r) { return c * 5 + r * r; });
}

Result<FileMesh> ReadGltfBytes(const std::string& bytes,
                               const std::filesystem::path& folder = "/nowhere",
                               const MeshLimits& limits = {}) {
  return ReadGltf({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, folder,
                  limits);
}

std::string ComplaintOfGltf(const TestGltf& gltf) {
  const Result<FileMesh> mesh = ReadGltfBytes(GlbBytes(gltf));
  return mesh ? "it is read" : mesh.error().message;
}

TEST(ReadGltfBytes, PlacesByAllNodesAboveAndTurnsWhatAMatrixMirrors) {
  TestGltf gltf = PlainGltf(SomeHills());
  // Up a quarter turn about x, then twice as large, then moved; the inner node mirrors.
  gltf.json["nodes"] =
      Json::array({{{"children", {1}}, {"translation", {100, 0, 0}}, {"scale", {2, 2, 2}}},
                   {{"children", {2}}, {"rotation", {std::sqrt(0.5), 0, 0, std::sqrt(0.5)}}},
                   {{"mesh", 0}, {"matrix", {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}}});
  const Result<FileMesh> mesh = ReadGltfBytes(GlbBytes(gltf));
  ASSERT_TRUE(mesh) << mesh.error().message;
  PlainMesh expected = SomeHills();
  for (auto& p : expected.points) p = {100 - 2 * p[0], -2 * p[2], 2 * p[1]};
  for (auto& t : expected.triangles) std::swap(t[1], t[2]);
  ASSERT_EQ(mesh->points.size(), expected.points.size());
  for (std::size_t i = 0; i < expected.points.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(mesh->points[i][k], expected.points[i][k], 1e-12);
    }
  }
  EXPECT_EQ(mesh->triangles, expected.triangles);
}

TEST(ReadGltfBytes, TakesEveryPrimitiveOfTrianglesStripsAndFans) {
  TestGltf gltf = PlainGltf({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 3, 2}}});
  Json& primitives = gltf.json["meshes"][0]["primitives"];
  const Json triangles = primitives[0];
  Json strip = triangles;
  strip.erase("indices");
  strip["mode"] = 5;
  Json fan = strip;
  fan["mode"] = 6;
  Json lines = strip;
  lines["mode"] = 1;
  const auto read = [&](const Json& primitive) {
    primitives = Json::array({lines, primitive});
    const Result<FileMesh> mesh = ReadGltfBytes(GlbBytes(gltf));
    if (!mesh) throw std::runtime_error(mesh.error().message);
    return TrianglesByPoint(*mesh);
  };
  EXPECT_EQ(read(strip), read(triangles));
  const TrianglePoints first = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  const TrianglePoints second = {{{0, 0, 0}, {0, 1, 0}, {1, 1, 0}}};
  EXPECT_EQ(read(fan), (std::vector<TrianglePoints>{second, first}));
  primitives = Json::array({lines});
  EXPECT_THAT(ComplaintOfGltf(gltf), HasSubstr("points and lines alone"));
}

TEST(ReadGltfBytes, TakesNormalizedNumbers) {
  TestGltf gltf = MeshoptGltf({{{32767, 0, 0}, {-32767, -32768, 0}, {0, 0, 16384}}, {{0, 1, 2}}});
  gltf.json["accessors"][0]["normalized"] = true;
  const Result<FileMesh> mesh = ReadGltfBytes(GlbBytes(gltf));
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->points,
            (std::vector<FilePoint>{{1, 0, 0}, {-1, -1, 0}, {0, 0, 16384.0 / 32767}}));
}

TEST(ReadGltfBytes, ReadsBuffersBesideItAndNothingElse) {
  const TempDir folder;
  std::filesystem::create_directory(folder / "in");
  TestGltf gltf = PlainGltf(SomeHills());
  SpillFile(folder / "in" / "a buffer.bin", gltf.buffer);
  SpillFile(folder / "out.bin", gltf.buffer);
  const auto read = [&](const std::string& uri) {
    gltf.json["buffers"] = Json::array({{{"byteLength", gltf.buffer.size()}, {"uri", uri}}});
    const Result<FileMesh> mesh = ReadGltfBytes(gltf.json.dump(), folder / "in");
    return mesh ? "" : mesh.error().message;
  };
  EXPECT_EQ(read("a%20buffer.bin"), "");
  EXPECT_EQ(read("./a buffer.bin"), "");
  for (const std::string& uri :
       {std::string("../out.bin"), (folder / "out.bin").string(), std::string("file:///etc/passwd"),
        std::string("https://example.org/a.bin"), std::string("%2e%2e/out.bin"),
        std::string("..%2Fout.bin"), std::string("a/../../out.bin"), std::string("a\\b.bin"),
        std::string("a%00b.bin"), std::string("")}) {
    EXPECT_THAT(read(uri), HasSubstr("only files beside it")) << uri;
  }
  EXPECT_THAT(read("none.bin"), HasSubstr("none.bin"));
  EXPECT_THAT(read("data:;base64,A$=="), HasSubstr("base64"));
  EXPECT_THAT(read("data:;base64,AAAA"), HasSubstr("beyond buffer 0"));
}

TEST(ReadGltfBytes, EndsWhereNodesRunInACircleOrAreReachedTwice) {
  TestGltf gltf = PlainGltf(SomeHills());
  gltf.json["nodes"] = Json::array({{{"children", {1}}}, {{"children", {0}}, {"mesh", 0}}});
  EXPECT_THAT(ComplaintOfGltf(gltf), HasSubstr("node 0 is reached twice"));
  gltf.json["nodes"] = Json::array({{{"children", {1, 1}}}, {{"mesh", 0}}});
  EXPECT_THAT(ComplaintOfGltf(gltf), HasSubstr("node 1 is reached twice"));
  gltf.json["nodes"] = Json::array({{{"children", {7}}}});
  EXPECT_THAT(ComplaintOfGltf(gltf), HasSubstr("not as glTF 2.0 has it"));
}

TEST(ReadGltfBytes, KeepsToTheLimitsWhereManyNodesShareAMesh) {
  TestGltf gltf = PlainGltf(SomeHills());
  Json nodes = Json::array();
  Json roots = Json::array();
  for (int i = 0; i < 100; ++i) {
    nodes.push_back({{"mesh", 0}});
    roots.push_back(i);
  }
  gltf.json["nodes"] = nodes;
  gltf.json["scenes"][0]["nodes"] = roots;
  const Result<FileMesh> mesh = ReadGltfBytes(GlbBytes(gltf), "/nowhere", {.max_points = 200});
  ASSERT_FALSE(mesh);
  EXPECT_EQ(mesh.error().kind, "mesh-too-large");
}

TEST(ReadGltfBytes, ChecksEveryNumber) {
  const TestGltf sound = PlainGltf(SomeHills());
  const auto with = [&](const std::string& pointer, const Json& value) {
    TestGltf gltf = sound;
    gltf.json[Json::json_pointer(pointer)] = value;
    return ComplaintOfGltf(gltf);
  };
  const Json numbers[] = {-1, 1e99, 0.5, "1", nullptr, 4294967296.0, Json::array(), 1 << 30};
  for (const Json& bad : numbers) {
    for (const char* pointer :
         {"/accessors/0/count", "/accessors/1/count", "/accessors/0/bufferView",
          "/accessors/0/byteOffset", "/accessors/0/componentType", "/bufferViews/0/byteOffset",
          "/bufferViews/0/byteLength", "/bufferViews/1/buffer",
          "/meshes/0/primitives/0/attributes/POSITION", "/meshes/0/primitives/0/indices",
          "/nodes/0/mesh", "/scenes/0/nodes/0", "/scene"}) {
      EXPECT_NE(with(pointer, bad), "it is read") << pointer << " " << bad;
    }
  }
  EXPECT_THAT(with("/accessors/0/sparse", Json::object()), HasSubstr("sparse"));
  EXPECT_THAT(with("/extensionsRequired", {"EXT_mesh_gpu_instancing"}),
              HasSubstr("EXT_mesh_gpu_instancing"));
  EXPECT_EQ(with("/extensionsRequired", {"KHR_materials_unlit"}), "it is read");
  std::string deep;
  for (int i = 0; i < 100'000; ++i) deep += "[";
  const Result<FileMesh> mesh = ReadGltfBytes("{\"a\":" + deep);
  ASSERT_FALSE(mesh);
  EXPECT_THAT(mesh.error().message, HasSubstr("64 deep"));
}

TEST(ReadGltfBytes, ChecksWhatMeshoptIsToldToDecode) {
  const TestGltf sound = MeshoptGltf(SomeHills());
  const auto with = [&](int view, const std::string& name, const Json& value) {
    TestGltf gltf = sound;
    gltf.json["bufferViews"][view]["extensions"]["EXT_meshopt_compression"][name] = value;
    return ComplaintOfGltf(gltf);
  };
  for (const Json& bad : {Json(0), Json(3), Json(257), Json(1 << 30)}) {
    EXPECT_NE(with(0, "byteStride", bad), "it is read") << bad;
    EXPECT_NE(with(1, "byteStride", bad), "it is read") << bad;
  }
  EXPECT_NE(with(0, "count", std::uint64_t{1} << 40U), "it is read");
  EXPECT_NE(with(1, "count", 35), "it is read") << "no whole number of triangles";
  EXPECT_NE(with(0, "mode", "INDICES"), "it is read");
  // The octahedral filter makes other points of them: it is applied.
  TestGltf octahedral = sound;
  octahedral.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"]["filter"] =
      "OCTAHEDRAL";
  const Result<FileMesh> filtered = ReadGltfBytes(GlbBytes(octahedral));
  const Result<FileMesh> plain = ReadGltfBytes(GlbBytes(sound));
  ASSERT_TRUE(plain) << plain.error().message;
  ASSERT_TRUE(filtered) << filtered.error().message;
  EXPECT_NE(filtered->points, plain->points);
}

}  // namespace
}  // namespace farhorizon

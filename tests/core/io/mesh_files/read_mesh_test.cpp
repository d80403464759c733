// One mesh through every format, and what no file should get away with.
#include "core/io/mesh_files/read_mesh.h"

#include <cmath>
#include <functional>
#include <limits>
#include <map>
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

PlainMesh Hills() {
  return GridMeshOf(7, 5, [](std::uint32_t c, std::uint32_t r) { return (c * 37 + r * 91) % 50; });
}

Result<FileMesh> ReadBytes(const std::string& name, const std::string& bytes,
                           const MeshLimits& limits = {}) {
  const TempDir folder;
  SpillFile(folder / name, bytes);
  return ReadMesh(folder / name, limits);
}

std::string Complaint(const std::string& name, const std::string& bytes,
                      const MeshLimits& limits = {}) {
  const Result<FileMesh> mesh = ReadBytes(name, bytes, limits);
  return mesh ? "it is read" : mesh.error().message;
}

struct Format {
  std::string name;
  std::string file;
  std::function<std::string(const PlainMesh&)> write;
};

void PrintTo(const Format& format, std::ostream* out) { *out << format.name; }

const Format kFormats[] = {
    {"Obj", "a.obj", ObjText},
    {"PlyText", "a.ply", PlyText},
    {"PlyLittleEndian", "a.ply", [](const PlainMesh& m) { return PlyBytes(m, false); }},
    {"PlyBigEndian", "a.ply", [](const PlainMesh& m) { return PlyBytes(m, true); }},
    {"StlText", "a.stl", StlText},
    {"StlBytes", "a.stl", StlBytes},
    {"DracoEdgebreaker", "a.drc", [](const PlainMesh& m) { return DracoText(m, true); }},
    {"DracoSequential", "a.drc", [](const PlainMesh& m) { return DracoText(m, false); }},
    {"Glb", "a.glb", [](const PlainMesh& m) { return GlbBytes(PlainGltf(m)); }},
    {"GlbDraco", "a.glb", [](const PlainMesh& m) { return GlbBytes(DracoGltf(m)); }},
    {"GlbMeshopt", "a.glb", [](const PlainMesh& m) { return GlbBytes(MeshoptGltf(m)); }},
    {"GltfText", "a.gltf", [](const PlainMesh& m) { return EmbeddedText(PlainGltf(m)); }},
};

class MeshFormats : public testing::TestWithParam<Format> {};

TEST_P(MeshFormats, HaveTheSameTriangles) {
  const PlainMesh hills = Hills();
  const Result<FileMesh> mesh = ReadBytes(GetParam().file, GetParam().write(hills));
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->points.size(), hills.points.size());
  EXPECT_EQ(TrianglesByPoint(*mesh), TrianglesByPoint(hills));
  const bool gltf = GetParam().file.find(".gl") != std::string::npos;
  EXPECT_EQ(mesh->frame, gltf ? FileFrame::kYUp : FileFrame::kUnstated);
}

TEST_P(MeshFormats, EndInAnErrorWhereverTheyAreCut) {
  const std::string whole = GetParam().write(Hills());
  for (std::size_t size = 0; size < whole.size(); size += 1 + size / 50) {
    const Result<FileMesh> mesh = ReadBytes(GetParam().file, whole.substr(0, size));
    // Text that is cut between faces is a smaller mesh.
    if (mesh) {
      EXPECT_TRUE(GetParam().name == "Obj" || GetParam().name == "StlText") << size;
    } else {
      EXPECT_FALSE(mesh.error().message.empty());
    }
  }
}

TEST_P(MeshFormats, StandAnyChangeOfAByte) {
  const std::string whole = GetParam().write(Hills());
  std::uint32_t random = 1;
  for (int i = 0; i < 200; ++i) {
    std::string changed = whole;
    for (int k = 0; k <= i % 3; ++k) {
      random = random * 1664525U + 1013904223U;
      changed[(random >> 8U) % changed.size()] = static_cast<char>(random >> 4U);
    }
    const Result<FileMesh> mesh = ReadBytes(
        GetParam().file, changed,
        {.max_points = 1000, .max_triangles = 1000, .max_bytes = std::uintmax_t{1} << 20U});
    if (!mesh) continue;
    for (const auto& t : mesh->triangles) {
      for (const std::uint32_t v : t) {
        for (const double x : mesh->points.at(v)) ASSERT_TRUE(std::isfinite(x));
      }
    }
  }
}

TEST_P(MeshFormats, KeepToTheLimits) {
  const std::string whole = GetParam().write(Hills());
  for (const MeshLimits& limits : {MeshLimits{.max_points = 34}, MeshLimits{.max_triangles = 47},
                                   MeshLimits{.max_bytes = whole.size() - 1}}) {
    const Result<FileMesh> mesh = ReadBytes(GetParam().file, whole, limits);
    ASSERT_FALSE(mesh);
    EXPECT_EQ(mesh.error().code, ErrorCode::kResourceExhausted) << mesh.error().message;
  }
}

INSTANTIATE_TEST_SUITE_P(All, MeshFormats, testing::ValuesIn(kFormats),
                         [](const auto& format) { return format.param.name; });

TEST(ReadMesh, SaysThatAnEmptyMeshHasNoTriangle) {
  for (const auto& [file, bytes] : {std::pair{"a.obj", ObjText({})},
                                    {"a.ply", PlyText({})},
                                    {"a.ply", PlyBytes({}, true)},
                                    {"a.stl", StlText({})},
                                    {"a.stl", StlBytes({})},
                                    {"a.glb", GlbBytes(PlainGltf({}))}}) {
    EXPECT_THAT(Complaint(file, bytes), HasSubstr("no triangle"));
  }
}

TEST(ReadMesh, NamesWhatItReadsWhereItCannotTellTheFormat) {
  EXPECT_THAT(Complaint("a.tif", "II*"), HasSubstr("OBJ, PLY, STL"));
  EXPECT_THAT(Complaint("a", ""), HasSubstr("OBJ, PLY, STL"));
  const Result<MeshFormat> missing = MeshFormatOf("/no/such/mesh.obj");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().kind, "no-such-file");
}

TEST(ReadMesh, TellsTheFormatByTheBytesFirst) {
  const Result<FileMesh> mesh = ReadBytes("a.obj", PlyBytes(Hills(), false));
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->triangles.size(), 48U);
}

TEST(ReadObj, TakesPolygonsCornersWithSlashesBackwardIndicesAndContinuedLines) {
  const Result<FileMesh> mesh = ReadBytes("a.obj",
                                          "v 0 0 0\r\nv 1 0 0 0.5 0.5 0.5\r\nv 1 1 \\\r\n0\r\n"
                                          "v +0 1e0 -0\r\nvt 0 0\r\nvn 0 0 1\r\n"
                                          "f 1/1 2/1/1 3//1 -1\r\n");
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->triangles.size(), 2U);
  EXPECT_EQ(mesh->polygons, 1);
}

TEST(ReadObj, NamesTheLineOfWhatItCannotRead) {
  EXPECT_THAT(Complaint("a.obj", "v 0 0\n"), HasSubstr("line 1"));
  EXPECT_THAT(Complaint("a.obj", "v 0 0 x\n"), HasSubstr("line 1"));
  EXPECT_THAT(Complaint("a.obj", "v 0 0 0\n\nf 1 2\n"), HasSubstr("line 3"));
  EXPECT_THAT(Complaint("a.obj", "v 0 0 0\nf 1 1 0\n"), HasSubstr("line 2"));
  EXPECT_THAT(Complaint("a.obj", "v 0 0 0\nf 1 -2 1\n"), HasSubstr("line 2"));
  EXPECT_THAT(Complaint("a.obj", "v 0 0 0\nf 1 2 99999999999999999999\n"), HasSubstr("line 2"));
  EXPECT_THAT(Complaint("a.obj", "v 0 0 0\nv 1 0 0\nf 1 2 3\n"), HasSubstr("point 2 of 2"));
  EXPECT_THAT(Complaint("a.obj", "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
              HasSubstr("no finite number"));
  EXPECT_THAT(Complaint("a.obj", "v 0 0 0\nv 1 0 0\nv 1 0 0\nf 1 2 3\n"),
              HasSubstr("two corners at one point"));
}

TEST(ReadObj, PassesOverPointsThatNoFaceUses) {
  const Result<FileMesh> mesh =
      ReadBytes("a.obj", "v nan 0 0\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 0\nf 2 3 4\nf 5 4 3\n");
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->points.size(), 3U) << "and one of points that are equal";
}

TEST(ReadPly, StandsHeadersThatPromiseTooMuch) {
  const std::string head = "ply\nformat ascii 1.0\n";
  EXPECT_THAT(Complaint("a.ply", head + "element vertex 1\nend_header\n"),
              HasSubstr("no triangle"));
  EXPECT_THAT(Complaint("a.ply", head + "element vertex 9223372036854775807\nproperty float x\n"
                                        "property float y\nproperty float z\nend_header\n0 0 0\n"),
              HasSubstr("vertex 1 of 9223372036854775807"));
  EXPECT_THAT(Complaint("a.ply", head + "element face 1\nproperty list int int vertex_index\n"
                                        "end_header\n4294967295 0 1 2\n"),
              HasSubstr("face 0 of 1"));
  EXPECT_THAT(Complaint("a.ply", head + "element face 1\nproperty list int int vertex_index\n"
                                        "end_header\n-3 0 1 2\n"),
              HasSubstr("face 0 of 1"));
  EXPECT_THAT(Complaint("a.ply", head + "element vertex 0\nproperty half x\nend_header\n"),
              HasSubstr("line 4"));
  EXPECT_THAT(Complaint("a.ply", "ply\nelement vertex 0\nend_header\n"), HasSubstr("no format"));
}

TEST(ReadStl, StandsAnyNumberOfTriangles) {
  std::string bytes = StlBytes(Hills());
  for (const char c : {'\x01', '\x7f', '\xff'}) {
    bytes[83] = c;
    EXPECT_THAT(Complaint("a.stl", bytes.replace(0, 5, "solut")), HasSubstr("cut short"));
  }
}

TEST(ReadDraco, RefusesStatedCountsBeforeItDecodes) {
  std::string bytes = DracoText(Hills(), false);
  // After 11 bytes of header the sequential coder has the number of faces, 48, in one byte.
  ASSERT_EQ(bytes[11], 48);
  bytes.replace(11, 1, "\xff\xff\xff\xff\x0f");
  EXPECT_THAT(Complaint("a.drc", bytes), HasSubstr("4294967295 triangles"));
  EXPECT_THAT(
      Complaint("a.drc", DracoText(Hills(), true).replace(5, 2, std::string("\x01\x00", 2))),
      HasSubstr("2.2 is the oldest"));
}

}  // namespace
}  // namespace farhorizon

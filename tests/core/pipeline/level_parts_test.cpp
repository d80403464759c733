#include "core/pipeline/level_parts.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "core/pipeline/level_tree.h"

namespace farhorizon {
namespace {

// All triangles of a grid but those of its first cells, in a plane of their own.
LocalMesh GridMesh(const Dem& dem, std::int32_t first_row) {
  LocalMesh mesh;
  for (std::int32_t r = first_row; r < dem.rows; ++r) {
    for (std::int32_t c = 0; c < dem.columns; ++c) {
      mesh.positions.push_back({double(c), -double(r), double(c * r % 7)});
      mesh.posts.push_back(static_cast<std::uint32_t>(r * dem.columns + c));
      mesh.normals.push_back({0, 0, 1});
    }
  }
  const auto columns = static_cast<std::uint32_t>(dem.columns);
  for (std::uint32_t v = 0; v + columns + 1 < mesh.posts.size(); ++v) {
    if (v % columns + 1 == columns) continue;
    mesh.triangles.push_back({v, v + columns, v + columns + 1});
    mesh.triangles.push_back({v, v + columns + 1, v + 1});
  }
  return mesh;
}

using Corners = std::array<std::uint32_t, 3>;  // posts

std::multiset<Corners> TrianglesOfParts(const LocalMesh& mesh) {
  std::multiset<Corners> triangles;
  for (const auto& [a, b, c] : mesh.triangles) {
    triangles.insert({mesh.posts[a], mesh.posts[b], mesh.posts[c]});
  }
  return triangles;
}

TEST(CutIntoParts, EachTriangleIsInThePartOfItsCellAndPartsJoinToTheWhole) {
  Dem dem;
  dem.columns = 40;
  dem.rows = 80;
  const PartDepth depth = {1, 2};
  const LocalMesh whole = GridMesh(dem, 25);  // none in the first row of parts
  const std::vector<MeshPart> parts = CutIntoParts(whole, dem, depth);
  ASSERT_EQ(parts.size(), 6U);
  EXPECT_EQ(parts.front().place, (PartPlace{0, 1}));
  EXPECT_EQ(parts.back().place, (PartPlace{1, 3}));
  std::vector<LocalMesh> meshes;
  for (const MeshPart& part : parts) {
    for (const std::uint32_t post : part.mesh.posts) {
      const std::int32_t column = static_cast<std::int32_t>(post) % dem.columns;
      const std::int32_t row = static_cast<std::int32_t>(post) / dem.columns;
      EXPECT_GE(column, part.place.column == 0 ? 0 : 19);
      EXPECT_LE(column, part.place.column == 0 ? 19 : 39);
      EXPECT_GE(row, part.place.row * 79 / 4);
      EXPECT_LE(row, (part.place.row + 1) * 79 / 4);
    }
    meshes.push_back(part.mesh);
  }
  const LocalMesh joined = JoinMeshes(meshes);
  EXPECT_EQ(joined.posts, whole.posts);  // each once, rising
  EXPECT_EQ(TrianglesOfParts(joined), TrianglesOfParts(whole));
}

TEST(JoinMeshes, VerticesThatDifferInAnythingStayApart) {
  Dem dem;
  dem.columns = dem.rows = 4;
  const LocalMesh one = GridMesh(dem, 0);
  LocalMesh raised = one;
  raised.positions[5].up += 1;
  LocalMesh turned = one;
  turned.normals[5] = {0, 1, 0};
  EXPECT_EQ(JoinMeshes({one, one}).posts.size(), 16U);
  EXPECT_EQ(JoinMeshes({one, raised}).posts.size(), 17U);
  EXPECT_EQ(JoinMeshes({one, turned}).posts.size(), 17U);
}

TEST(PartGlbName, HasThePartOnlyWhereTheLevelIsCut) {
  EXPECT_EQ(PartGlbName(3, {}, {}), "lod3.glb");
  EXPECT_EQ(PartGlbName(0, {2, 1}, {3, 1}), "lod0-3-1.glb");
  EXPECT_EQ(PartGlbName(0, {1, 0}, {0, 0}), "lod0-0-0.glb");
}

}  // namespace
}  // namespace farhorizon

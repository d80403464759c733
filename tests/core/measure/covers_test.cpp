#include "core/measure/covers.h"

#include <numeric>

#include <gtest/gtest.h>

#include "tests/support/drawn_dem.h"
#include "tests/support/measured_meshes.h"

namespace farhorizon {
namespace {

// The kind of the fault that is found; empty: none.
std::string FaultOf(const Terrain& terrain, const GridMesh& mesh) {
  std::vector<VertexId> posts(mesh.points.size());
  std::iota(posts.begin(), posts.end(), 0);
  Status covers = CheckCovers(terrain, mesh, posts);
  return covers ? "" : std::string(covers.error().kind);
}

TEST(Covers, TheTerrainItselfDoes) {
  const Dem dem = FractalDem(3, 4);
  const Terrain terrain = *Terrain::Build(dem);
  GridMesh mesh = MeshOf(terrain);
  EXPECT_EQ(FaultOf(terrain, mesh), "");
  std::mt19937 random(1);
  Shake(mesh, 0.2, 100, random);
  EXPECT_EQ(FaultOf(terrain, mesh), "");
}

TEST(Covers, FaultsAreFound) {
  const Dem dem = FractalDem(3, 4);
  const Terrain terrain = *Terrain::Build(dem);
  const GridMesh whole = MeshOf(terrain);

  GridMesh mesh = whole;
  mesh.triangles.erase(mesh.triangles.begin());
  EXPECT_EQ(FaultOf(terrain, mesh), "hole");

  mesh = whole;
  std::swap(mesh.triangles[5][0], mesh.triangles[5][1]);
  EXPECT_EQ(FaultOf(terrain, mesh), "flipped-triangle");

  mesh = whole;
  mesh.points[7].row += 0.6;
  EXPECT_EQ(FaultOf(terrain, mesh), "displaced-vertex");

  mesh = whole;
  mesh.triangles[9] = mesh.triangles[10];
  EXPECT_EQ(FaultOf(terrain, mesh), "overlap");

  mesh = whole;
  mesh.triangles[9][2] = 5000;
  EXPECT_EQ(FaultOf(terrain, mesh), "unknown-point");

  mesh = whole;
  mesh.points.pop_back();
  mesh.points.push_back({8, 8, 0});
  mesh.points.push_back({8, 8, 0});
  EXPECT_EQ(FaultOf(terrain, mesh), "unknown-post");
  EXPECT_EQ(std::string(CheckCovers(terrain, whole, {1, 2}).error().kind), "unnamed-points");
}

TEST(Covers, ATJunctionIsAHole) {
  const Dem dem = DemOf(3, 3, [](int, int) { return 0; });
  const Terrain terrain = *Terrain::Build(dem);
  GridMesh mesh = MeshOf(terrain);
  // South: cells of one step. North: two steps wide, so that post 4 lies inside their lower side.
  mesh.triangles = {{0, 5, 2}, {0, 3, 5}, {3, 6, 7}, {3, 7, 4}, {4, 7, 8}, {4, 8, 5}};
  EXPECT_EQ(FaultOf(terrain, mesh), "hole");
}

}  // namespace
}  // namespace farhorizon

#include "core/simplify/mesh/half_edge_mesh.h"

#include <algorithm>
#include <array>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/ascii_dem.h"
#include "tests/support/effort.h"
#include "tests/support/half_edge_checks.h"
#include "tests/support/random_operations.h"
#include "tests/support/small_terrains.h"

namespace farhorizon {
namespace {

// The slow twin of a collapse: v becomes b, and what has b twice is gone.
std::set<Corners> Collapsed(const std::set<Corners>& triangles, std::int32_t v, std::int32_t b) {
  std::set<Corners> left;
  for (Corners t : triangles) {
    std::replace(t.begin(), t.end(), v, b);
    if (std::count(t.begin(), t.end(), b) < 2) left.insert(Turned(t));
  }
  return left;
}

struct OnTerrain {
  explicit OnTerrain(const Dem& of)
      : dem(of), terrain(*Terrain::Build(dem)), ground(terrain, {}), mesh(ground) {}
  Dem dem;
  Terrain terrain;
  Ground ground;
  HalfEdgeMesh mesh;
};

TEST(HalfEdgeMesh, BeginsWithTheTrianglesOfTheTerrain) {
  std::mt19937 random(1);
  int knots = 0;
  for (int round = 0; round < Rounds(3000); ++round) {
    const OnTerrain on(AnySmallDem(9, random));
    std::set<Corners> wanted;
    for (const Triangle& t : on.terrain.Triangles()) wanted.insert(Turned({t[0], t[2], t[1]}));
    ASSERT_EQ(TrianglesOf(on.mesh), wanted) << DrawAscii(on.dem);
    ASSERT_EQ(FaultOfMesh(on.mesh), "") << DrawAscii(on.dem);
    for (std::int32_t v = 0; v < on.mesh.vertices(); ++v) {
      knots += static_cast<int>(on.mesh.IsVertex(v) && on.mesh.IsKnotted(v));
    }
  }
  EXPECT_GT(knots, 100);
}

TEST(HalfEdgeMesh, APostBetweenTwoFansIsKnotted) {
  const OnTerrain on(AsciiDem("1 1 .\n1 1 1\n. 1 1"));
  const OnTerrain two(AsciiDem("1 1 . .\n1 1 . .\n. . 1 1\n. . 1 1"));
  EXPECT_FALSE(on.mesh.IsKnotted(4));
  EXPECT_EQ(on.mesh.degree(4), 6);
  EXPECT_EQ(FaultOfMesh(two.mesh), "");
  const OnTerrain knot(AsciiDem("1 1 .\n. 1 .\n. 1 1"));
  EXPECT_TRUE(knot.mesh.IsKnotted(4));
}

TEST(HalfEdgeMesh, CollapsesAndFlipsChangeWhatTheyNameAndNothingElse) {
  std::mt19937 random(2);
  int collapses = 0;
  int flips = 0;
  for (int round = 0; round < Rounds(1500); ++round) {
    OnTerrain on(AnySmallDem(8, random));
    HalfEdgeMesh& mesh = on.mesh;
    Ring ring;
    for (int step = 0; step < 60; ++step) {
      std::set<Corners> wanted = TrianglesOf(mesh);
      const auto v = static_cast<std::int32_t>(random() % static_cast<unsigned>(mesh.vertices()));
      const auto h = static_cast<std::int32_t>(random() % static_cast<unsigned>(mesh.half_edges()));
      if (step % 3 > 0 && mesh.IsVertex(v) && mesh.Gather(v, ring)) {
        const auto j = static_cast<std::int32_t>(random() % static_cast<unsigned>(ring.count));
        if (!MayCollapse(mesh, ring, j)) continue;
        wanted = Collapsed(wanted, v, ring.id(j));
        mesh.Collapse(ring, ring.id(j));
        ++collapses;
      } else if (MayFlip(mesh, h)) {
        const std::int32_t a = mesh.origin(h);
        const std::int32_t c = mesh.origin(HalfEdgeMesh::Next(h));
        const std::int32_t b = mesh.origin(HalfEdgeMesh::Previous(h));
        const std::int32_t d = mesh.origin(HalfEdgeMesh::Previous(mesh.twin(h)));
        wanted.erase(Turned({a, c, b}));
        wanted.erase(Turned({c, a, d}));
        wanted.insert(Turned({d, c, b}));
        wanted.insert(Turned({d, b, a}));
        mesh.Flip(h);
        ++flips;
      } else {
        continue;
      }
      ASSERT_EQ(TrianglesOf(mesh), wanted) << DrawAscii(on.dem);
      ASSERT_EQ(FaultOfMesh(mesh), "") << DrawAscii(on.dem);
    }
  }
  EXPECT_GT(collapses, Rounds(5000));
  EXPECT_GT(flips, Rounds(2000));
}

TEST(HalfEdgeMesh, CuttingOffARimVertexFillsWhatItsTrianglesCovered) {
  std::mt19937 random(3);
  int cuts = 0;
  int wide = 0;
  for (int round = 0; round < Rounds(3000); ++round) {
    OnTerrain on(AnySmallDem(8, random));
    HalfEdgeMesh& mesh = on.mesh;
    Rearrange(mesh, 120, random);
    for (std::int32_t v = 0; v < mesh.vertices(); ++v) {
      if (!MayCutOff(mesh, v)) continue;
      const std::set<Corners> before = TrianglesOf(mesh);
      std::set<std::int32_t> around;
      for (const Corners& t : before) {
        if (std::count(t.begin(), t.end(), v) > 0) around.insert(t.begin(), t.end());
      }
      wide += static_cast<int>(around.size() > 5);
      mesh.CutOff(v);
      ++cuts;
      ASSERT_FALSE(mesh.IsVertex(v));
      ASSERT_EQ(FaultOfMesh(mesh), "") << DrawAscii(on.dem);
      const std::set<Corners> after = TrianglesOf(mesh);
      for (const Corners& t : before) {
        ASSERT_EQ(after.count(t), std::count(t.begin(), t.end(), v) == 0 ? 1U : 0U);
      }
      for (const Corners& t : after) {
        if (before.count(t) > 0) continue;
        for (const std::int32_t corner : t) ASSERT_EQ(around.count(corner), 1U);
      }
    }
  }
  EXPECT_GT(cuts, Rounds(3000));
  EXPECT_GT(wide, Rounds(100));
}

TEST(HalfEdgeMesh, KeepsItsTrianglesInOrderWhenItClosesGaps) {
  std::mt19937 random(4);
  for (int round = 0; round < Rounds(500); ++round) {
    OnTerrain on(AnySmallDem(9, random));
    HalfEdgeMesh& mesh = on.mesh;
    Rearrange(mesh, 60, random);
    const auto list = [&mesh] {
      std::vector<std::array<float, 4>> triangles;
      for (std::int32_t h = 0; h < mesh.half_edges(); h += 3) {
        if (!mesh.Stands(h / 3)) continue;
        triangles.push_back({static_cast<float>(mesh.origin(h)),
                             static_cast<float>(mesh.origin(h + 1)),
                             static_cast<float>(mesh.origin(h + 2)), mesh.squares(h / 3)});
      }
      return triangles;
    };
    const auto before = list();
    mesh.Compact();
    ASSERT_EQ(list(), before);
    ASSERT_EQ(mesh.half_edges(), 3 * mesh.triangles());
    ASSERT_EQ(FaultOfMesh(mesh), "") << DrawAscii(on.dem);
  }
}

TEST(HalfEdgeMesh, LeavesAVertexWithTooManyNeighboursAlone) {
  // A fan of 2 x 80 posts, collapsed onto one corner of the lower row as far as that goes.
  const OnTerrain on(AsciiDem(std::string(80, '1') + "\n" + std::string(80, '1')));
  HalfEdgeMesh mesh = on.mesh;
  Ring ring;
  for (std::int32_t v = 158; v > 80; --v) {
    ASSERT_TRUE(mesh.Gather(v, ring));
    const auto* end = ring.neighbour.begin() + ring.count;
    const auto j = static_cast<std::int32_t>(std::find(ring.neighbour.cbegin(), end, 159) -
                                             ring.neighbour.begin());
    ASSERT_LT(j, ring.count);
    ASSERT_TRUE(MayCollapse(mesh, ring, j));
    mesh.Collapse(ring, 159);
  }
  EXPECT_EQ(mesh.degree(159), 81);
  EXPECT_FALSE(mesh.Gather(159, ring));
  EXPECT_EQ(mesh.GatherRim(159).size(), 80U);
}

}  // namespace
}  // namespace farhorizon

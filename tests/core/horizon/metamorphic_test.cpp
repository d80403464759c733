// Maps under which the answer does not change: horizon edges follow every invertible affine map of
// the plan, scaled and lifted heights, and a finer triangulation of the same surface
// (core/horizon/README.md, "Invariance"). Where the image of a grid is a grid, both engines are
// run. Elsewhere segments are mapped, which have no diagonals, and the answer on the grid comes
// from either engine.
#include <algorithm>
#include <array>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/horizon/find_horizon.h"
#include "core/horizon/join_horizons.h"
#include "core/horizon/kinetic/kinetic_horizon.h"
#include "tests/oracles/horizon_brute_force.h"
#include "tests/support/ascii_dem.h"
#include "tests/support/effort.h"
#include "tests/support/terrains.h"

namespace farhorizon {
namespace {

std::vector<Edge> FindAdaptively(const Terrain& terrain) {
  std::vector<Edge> edges;
  const Horizon horizon = *FindHorizon(terrain, {}, {});
  for (const HorizonEdge& e : horizon.edges) edges.push_back(e.edge);
  return edges;
}

std::vector<Edge> FindKinetically(const Terrain& terrain) {
  return (*FindHorizonKinetic(terrain, {})).edges;
}

struct NamedEngine {
  std::string name;
  std::vector<Edge> (*find)(const Terrain&);
};

class Metamorphic : public testing::TestWithParam<NamedEngine> {
 protected:
  static std::vector<Edge> Find(const Dem& dem) { return GetParam().find(*Terrain::Build(dem)); }
};
INSTANTIATE_TEST_SUITE_P(Engines, Metamorphic,
                         testing::Values(NamedEngine{"Adaptive", FindAdaptively},
                                         NamedEngine{"Kinetic", FindKinetically}),
                         [](const auto& engine) { return engine.param.name; });

// A random DEM that has a surface; fractal every tenth time.
Dem SomeDem(int round, std::int32_t max_side, std::mt19937& random) {
  if (round % 10 == 0)
    return FractalDem(19 + round % 7, 300, 100, static_cast<std::uint32_t>(random()));
  for (;;) {
    Dem dem = AnyRandomDem(2, max_side, random);
    if (Terrain::Build(dem)) return dem;
  }
}

Dem WithoutHoles(Dem dem) {
  for (std::int32_t& h : dem.heights) h = h == kNoHeight ? 0 : h;
  return dem;
}

std::int32_t HeightWithin(const Dem& dem, std::int32_t c, std::int32_t r) {
  const VertexId v = r * dem.columns + c;
  return dem.heights[static_cast<std::size_t>(v)];
}

// Turns by 60 degrees and their mirror images map the triangulated grid to itself, except a cell
// without data at one post.
TEST_P(Metamorphic, FollowsTheTwelveMapsOfTheTriangulatedGrid) {
  std::mt19937 random(1);
  for (int round = 0; round < Rounds(50); ++round) {
    const Dem dem = WithoutHoles(SomeDem(round, 9, random));
    const std::vector<Edge> edges = Find(dem);
    for (const GridMap& map : AllGridMaps()) {
      const MappedDem mapped = MapDem(dem, map);
      ASSERT_EQ(Find(mapped.dem), MapEdges(edges, mapped.image))
          << DrawAscii(dem) << map.xx << ' ' << map.xy << ' ' << map.yx << ' ' << map.yy;
    }
  }
}

TEST_P(Metamorphic, FollowsHalfTurnsAndTranspositionsOfGridsWithHoles) {
  std::mt19937 random(2);
  for (int round = 0; round < Rounds(120); ++round) {
    const Dem dem = SomeDem(round, 9, random);
    const std::vector<Edge> edges = Find(dem);
    for (const GridMap& map : {GridMap{-1, 0, 0, -1}, GridMap{0, 1, 1, 0}, GridMap{0, -1, -1, 0}}) {
      const MappedDem mapped = MapDem(dem, map);
      ASSERT_EQ(Find(mapped.dem), MapEdges(edges, mapped.image)) << DrawAscii(dem);
    }
  }
}

TEST_P(Metamorphic, IsTheSameForScaledAndLiftedHeights) {
  std::mt19937 random(3);
  for (int round = 0; round < Rounds(100); ++round) {
    const Dem dem = SomeDem(round, 9, random);
    const std::vector<Edge> edges = Find(dem);
    for (const std::int32_t factor : {2, 3, 1001, 1 << 18}) {
      ASSERT_EQ(Find(MapHeights(dem, factor, 54'321 - 17 * round)), edges) << DrawAscii(dem);
    }
  }
}

TEST_P(Metamorphic, IsTheSameInAFrameWithoutData) {
  std::mt19937 random(4);
  for (int round = 0; round < Rounds(100); ++round) {
    const Dem dem = SomeDem(round, 9, random);
    const std::int32_t left = round % 3;
    const std::int32_t top = round % 5;
    const Dem framed = MakeDem(dem.columns + 5, dem.rows + 5, [&](std::int32_t c, std::int32_t r) {
      const bool inside = c >= left && c < left + dem.columns && r >= top && r < top + dem.rows;
      return inside ? HeightWithin(dem, c - left, r - top) : kNoHeight;
    });
    std::vector<VertexId> image;
    for (VertexId v = 0; v < dem.columns * dem.rows; ++v) {
      image.push_back((dem.Row(v) + top) * framed.columns + dem.Column(v) + left);
    }
    ASSERT_EQ(Find(framed), MapEdges(Find(dem), image)) << DrawAscii(dem);
  }
}

// The same surface on a grid `times` as fine, heights `times` as high so that they stay whole.
Dem RefinedDem(const Dem& dem, std::int32_t times) {
  return MakeDem(
      (dem.columns - 1) * times + 1, (dem.rows - 1) * times + 1,
      [&](std::int32_t c, std::int32_t r) {
        const std::int32_t column = std::min(c / times, dem.columns - 2);
        const std::int32_t row = std::min(r / times, dem.rows - 2);
        const std::int32_t x = c - column * times;
        const std::int32_t y = r - row * times;
        const std::int32_t corner = HeightWithin(dem, column, row);
        const std::int32_t opposite = HeightWithin(dem, column + 1, row + 1);
        // Along two sides of the triangle that (x, y) is in, to the diagonal's far end.
        return x >= y ? times * corner + (x - y) * (HeightWithin(dem, column + 1, row) - corner) +
                            y * (opposite - corner)
                      : times * corner + (y - x) * (HeightWithin(dem, column, row + 1) - corner) +
                            x * (opposite - corner);
      });
}

// The edges of the coarse grid that fine edges are parts of. Requires: those lie on coarse ones.
std::vector<Edge> Coarse(const std::vector<Edge>& fine, const Dem& fine_dem, const Dem& dem,
                         std::int32_t times) {
  std::vector<Edge> edges;
  for (const Edge e : fine) {
    const auto post = [&](VertexId v, VertexId towards) {
      // On along the edge, back from `towards`, to the next post of the coarse grid.
      const std::int32_t dc = fine_dem.Column(v) - fine_dem.Column(towards);
      const std::int32_t dr = fine_dem.Row(v) - fine_dem.Row(towards);
      std::int32_t c = fine_dem.Column(v);
      std::int32_t r = fine_dem.Row(v);
      for (; c % times != 0 || r % times != 0; c += dc, r += dr) {
        Check(c >= 0 && r >= 0 && c < fine_dem.columns && r < fine_dem.rows,
              "an edge of the horizon lies on one of the coarse grid");
      }
      return r / times * dem.columns + c / times;
    };
    edges.push_back(MakeEdge(post(e.a, e.b), post(e.b, e.a)));
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

TEST_P(Metamorphic, IsTheSameForTheSurfaceOnAFinerGrid) {
  std::mt19937 random(5);
  for (int round = 0; round < Rounds(60); ++round) {
    const Dem dem = WithoutHoles(SomeDem(round, 8, random));
    const std::vector<Edge> edges = Find(dem);
    for (const std::int32_t times : {2, 3}) {
      const Dem fine = RefinedDem(dem, times);
      ASSERT_EQ(Coarse(Find(fine), fine, dem, times), edges) << DrawAscii(dem);
    }
  }
}

// `mesh` with its plan under a matrix, shifted back to where columns and rows begin.
OracleMesh MapMesh(OracleMesh mesh, const GridMap& map) {
  std::int32_t left = 0;
  std::int32_t top = 0;
  for (Point3i& p : mesh.points) {
    p = {map.xx * p.x + map.xy * p.y, map.yx * p.x + map.yy * p.y, p.z};
    left = std::min(left, p.x);
    top = std::min(top, p.y);
  }
  for (Point3i& p : mesh.points) p = {p.x - left, p.y - top, p.z};
  return mesh;
}

// The horizon edges of any mesh, by the adaptive engine's decisions alone.
std::vector<Edge> HorizonOfCreases(const OracleMesh& mesh) {
  const std::vector<Edge> creases = CreasesOf(mesh);
  std::vector<Segment> segments;
  std::int32_t columns = 0;
  std::int32_t rows = 0;
  for (const Edge e : creases) {
    const Point3i a = mesh.points[static_cast<std::size_t>(e.a)];
    const Point3i b = mesh.points[static_cast<std::size_t>(e.b)];
    segments.push_back({a, b});
    columns = std::max({columns, a.x + 1, b.x + 1});
    rows = std::max({rows, a.y + 1, b.y + 1});
  }
  std::vector<Edge> edges;
  const std::vector<std::size_t> kept = *FindHorizonSegments(segments, columns, rows, {});
  for (const std::size_t i : kept) edges.push_back(creases[i]);
  return edges;
}

// Quarter turns, reflections, shears, and maps that change areas: most of them map no grid to a
// grid with the same diagonals.
TEST(MetamorphicSegments, FollowEveryIntegerMatrixFromBothEnginesAnswers) {
  constexpr std::array<GridMap, 10> kMaps{{{0, -1, 1, 0},
                                           {0, 1, -1, 0},
                                           {-1, 0, 0, 1},
                                           {1, 0, 0, -1},
                                           {1, 2, 0, 1},
                                           {1, 0, -3, 1},
                                           {2, 1, 1, 1},
                                           {3, 1, -1, 2},
                                           {1, 7, 0, -5},
                                           {11, 4, 3, 1}}};
  std::mt19937 random(6);
  for (int round = 0; round < Rounds(60); ++round) {
    const Dem dem = SomeDem(round, 9, random);
    const Terrain terrain = *Terrain::Build(dem);
    const std::vector<Edge> edges = FindAdaptively(terrain);
    ASSERT_EQ(FindKinetically(terrain), edges) << DrawAscii(dem);
    for (const GridMap& map : kMaps) {
      ASSERT_EQ(HorizonOfCreases(MapMesh(MeshOf(terrain), map)), edges)
          << DrawAscii(dem) << map.xx << ' ' << map.xy << ' ' << map.yx << ' ' << map.yy;
    }
  }
}

TEST(MetamorphicSegments, FollowEveryIntegerMatrixInTheDefinitionToo) {
  std::mt19937 random(7);
  for (int round = 0; round < Rounds(30); ++round) {
    const Dem dem = SomeDem(1 + round % 9, 5, random);
    const Terrain terrain = *Terrain::Build(dem);
    for (const GridMap& map : {GridMap{0, -1, 1, 0}, GridMap{1, 2, 0, 1}, GridMap{3, 1, -1, 2}}) {
      ASSERT_EQ(HorizonByBruteForce(MapMesh(MeshOf(terrain), map)), FindKinetically(terrain))
          << DrawAscii(dem);
    }
  }
}

// The mesh over a grid whose cells are split along the other diagonal, from (column + 1, row) to
// (column, row + 1).
OracleMesh OtherDiagonalMesh(const Dem& dem) {
  OracleMesh mesh;
  for (VertexId v = 0; v < dem.columns * dem.rows; ++v) {
    mesh.points.push_back({dem.Column(v), dem.Row(v), dem.heights[static_cast<std::size_t>(v)]});
  }
  for (std::int32_t r = 0; r + 1 < dem.rows; ++r) {
    for (std::int32_t c = 0; c + 1 < dem.columns; ++c) {
      const VertexId v = r * dem.columns + c;
      std::vector<VertexId> corners = {v + 1, v, v + dem.columns, v + dem.columns + 1};
      std::erase_if(corners, [&dem](VertexId corner) { return !dem.HasData(corner); });
      if (corners.size() < 3) continue;
      mesh.triangles.push_back({corners[0], corners[1], corners[2]});
      if (corners.size() == 4) mesh.triangles.push_back({corners[0], corners[2], corners[3]});
    }
  }
  return mesh;
}

// The four symmetries of the square that exchange its two diagonals.
TEST(MetamorphicSegments, FollowQuarterTurnsAndReflectionsToTheOtherDiagonal) {
  std::mt19937 random(8);
  for (int round = 0; round < Rounds(100); ++round) {
    const Dem dem = SomeDem(round, 7, random);
    const Terrain terrain = *Terrain::Build(dem);
    const std::vector<Edge> edges = FindKinetically(terrain);
    ASSERT_EQ(FindAdaptively(terrain), edges) << DrawAscii(dem);
    for (const GridMap& map :
         {GridMap{0, -1, 1, 0}, GridMap{0, 1, -1, 0}, GridMap{-1, 0, 0, 1}, GridMap{1, 0, 0, -1}}) {
      const MappedDem mapped = MapDem(dem, map);
      const OracleMesh mesh = OtherDiagonalMesh(mapped.dem);
      ASSERT_EQ(HorizonOfCreases(mesh), MapEdges(edges, mapped.image)) << DrawAscii(dem);
    }
  }
}

}  // namespace
}  // namespace farhorizon

#include "core/simplify/lod_chain.h"

#include <filesystem>

#include <gtest/gtest.h>

#include "core/geometry/plan.h"
#include "core/horizon/find_horizon.h"
#include "core/io/dem/read_dem.h"
#include "core/terrain/border.h"
#include "tests/support/drawn_dem.h"
#include "tests/support/line_heights.h"
#include "tests/support/mesh_checks.h"

namespace farhorizon {
namespace {

// Doubles carry heights below 2^20 to better than this.
constexpr double kRounding = 1e-6;

std::vector<LevelBudget> Budgets(double vertical, int levels) {
  std::vector<LevelBudget> budgets;
  for (int i = 0; i < levels; ++i, vertical *= 2) {
    budgets.push_back({vertical, i == 0 ? 0 : vertical / 8, 0, 0});
  }
  return budgets;
}

struct Chain {
  Dem dem;
  Terrain terrain;
  Horizon horizon;
  std::vector<Lod> levels;
};

Chain Build(const Dem& dem, const std::vector<LevelBudget>& budgets) {
  Terrain terrain = *Terrain::Build(dem);
  Horizon horizon = *FindHorizon(terrain, {}, {});
  std::vector<Lod> levels = *BuildLodChain(terrain, horizon, budgets, {});
  return {dem, terrain, std::move(horizon), std::move(levels)};
}

double GreatestSilhouetteError(const Chain& chain, const Lod& level, int lines) {
  const std::vector<Triangle> full = chain.terrain.Triangles();
  std::mt19937 random(11);
  double greatest = 0;
  for (int i = 0; i < lines; ++i) {
    const RationalLine line = RandomLine(chain.dem, random);
    const double wanted = HeightOverLine(chain.terrain, full, line);
    const double found = HeightOverLine(chain.terrain, level.mesh.triangles, line);
    if (std::isinf(wanted) && std::isinf(found)) continue;
    greatest = std::max(greatest, std::abs(wanted - found));
  }
  return greatest;
}

TEST(LodChain, TheFinestLevelHasTheSkylineOfTheDem) {
  for (std::uint32_t seed = 0; seed < 4; ++seed) {
    const Dem dem = WithHoles(FractalDem(5, seed), static_cast<int>(seed), seed);
    const Chain chain = Build(dem, {{60, 0, 0, 0}});
    EXPECT_LT(chain.levels[0].mesh.triangles.size(), chain.terrain.Triangles().size());
    EXPECT_LE(GreatestSilhouetteError(chain, chain.levels[0], 2000), kRounding) << "seed " << seed;
    EXPECT_EQ(chain.levels[0].kept.size(), chain.horizon.edges.size());
  }
}

TEST(LodChain, AValleyBetweenTwoRidgesIsNotFilled) {
  // Ridges kept, the posts of the floor removed: triangles from ridge to ridge would be a skyline
  // that the DEM does not have (core/simplify/README.md, section 2).
  const Dem dem = DemOf(25, 25, [](int c, int r) {
    const int off = std::min(std::abs(r - 8), std::abs(r - 16));
    return 100 - 25 * off + (c % 5 == 0 ? 0 : 1);
  });
  const Chain chain = Build(dem, {{1000, 0, 0, 0}});
  EXPECT_LE(GreatestSilhouetteError(chain, chain.levels[0], 4000), kRounding);
}

TEST(LodChain, ACraterIsSimplifiedInsideItsRim) {
  const Dem dem = DemOf(33, 33, [](int c, int r) {
    const double off = std::hypot(c - 16, r - 16);
    return static_cast<std::int32_t>(std::lround(100 - 10 * std::abs(off - 10) + (c * 7 + r) % 3));
  });
  const Chain chain = Build(dem, {{100, 0, 0, 0}});
  EXPECT_LE(GreatestSilhouetteError(chain, chain.levels[0], 3000), kRounding);
  EXPECT_LT(chain.levels[0].mesh.triangles.size(), chain.terrain.Triangles().size() * 3 / 4);
}

TEST(LodChain, EachLevelStaysWithinBothBudgetsAndCoversTheDomain) {
  for (std::uint32_t seed = 0; seed < 3; ++seed) {
    const Dem dem = WithHoles(FractalDem(5, 20 + seed), static_cast<int>(seed), seed);
    const std::vector<LevelBudget> budgets = Budgets(10, 4);
    const Chain chain = Build(dem, budgets);
    for (std::size_t i = 0; i < budgets.size(); ++i) {
      const std::vector<Triangle>& mesh = chain.levels[i].mesh.triangles;
      EXPECT_EQ(FaultOfCover(chain.terrain, mesh), "") << "seed " << seed << ", level " << i;
      EXPECT_LE(GreatestVerticalError(chain.terrain, mesh), budgets[i].vertical_error_m);
      EXPECT_LE(GreatestSilhouetteError(chain, chain.levels[i], 1000),
                budgets[i].silhouette_error_m + kRounding)
          << "seed " << seed << ", level " << i;
    }
  }
}

TEST(LodChain, NoTriangleIsSteeperThanTheDem) {
  const Dem dem = FractalDem(5, 25);
  const Chain chain = Build(dem, Budgets(10, 4));
  const auto steepest = [&](const std::vector<Triangle>& mesh) {
    Slope most;
    for (const Triangle& t : mesh) {
      const Slope slope =
          SlopeOf(chain.terrain.Point(t[0]), chain.terrain.Point(t[1]), chain.terrain.Point(t[2]));
      most.by_column = std::max(most.by_column, slope.by_column);
      most.by_row = std::max(most.by_row, slope.by_row);
    }
    return most;
  };
  const Slope allowed = steepest(chain.terrain.Triangles());
  for (const Lod& level : chain.levels) {
    const Slope found = steepest(level.mesh.triangles);
    EXPECT_LE(found.by_column, allowed.by_column);
    EXPECT_LE(found.by_row, allowed.by_row);
  }
}

TEST(LodChain, TheOutlineRunsWhereTheTerrainEnds) {
  // Many holes: a wrong move along one can take from the domain just what it adds elsewhere.
  for (std::uint32_t seed = 0; seed < 40; ++seed) {
    const Dem dem = WithHoles(FractalDem(5, 70 + seed), 12, seed);
    const Chain chain = Build(dem, Budgets(40, 3));
    for (const Lod& level : chain.levels) {
      for (const Edge& edge : OutlineOf(level.mesh.triangles)) {
        EXPECT_TRUE(RunsAlongOutline(chain.terrain, edge))
            << "seed " << seed << ", posts " << edge.a << " and " << edge.b;
      }
    }
  }
}

TEST(LodChain, ALevelKeepsOnlyHorizonEdgesThatTheFinerOneKeepsAndHasThem) {
  const Chain chain = Build(FractalDem(5, 31), Budgets(10, 5));
  for (std::size_t i = 0; i < chain.levels.size(); ++i) {
    std::set<Edge> sides;
    for (const Triangle& t : chain.levels[i].mesh.triangles) {
      for (std::size_t k = 0; k < 3; ++k) sides.insert(MakeEdge(t[k], t[(k + 1) % 3]));
    }
    std::vector<std::int32_t> present;
    for (std::size_t e = 0; e < chain.horizon.edges.size(); ++e) {
      if (sides.count(chain.horizon.edges[e].edge) > 0) {
        present.push_back(static_cast<std::int32_t>(e));
      }
    }
    EXPECT_EQ(chain.levels[i].kept, present);
    if (i == 0) continue;
    EXPECT_TRUE(std::includes(chain.levels[i - 1].kept.begin(), chain.levels[i - 1].kept.end(),
                              present.begin(), present.end()));
  }
  EXPECT_LT(chain.levels.back().kept.size(), chain.levels.front().kept.size());
}

TEST(LodChain, KeepsTheSkylineOfRealHillsWithLessThanHalfTheTriangles) {
  const std::filesystem::path path = std::filesystem::path(FARHORIZON_DEM_DIR) / "gabilan_65.tif";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no gabilan_65.tif in FARHORIZON_DEM_DIR";
  const Dem dem = *ReadDem(path, {});
  const Chain chain = Build(dem, {{0.125, 0, 0, 0}, {0.5, 0.0625, 0, 0}});
  const double quantum = dem.quantum_m;
  EXPECT_LE(GreatestSilhouetteError(chain, chain.levels[0], 1000), kRounding);
  EXPECT_LE(GreatestSilhouetteError(chain, chain.levels[1], 1000) * quantum, 0.0625 + kRounding);
  EXPECT_LE(GreatestVerticalError(chain.terrain, chain.levels[1].mesh.triangles) * quantum, 0.5);
  EXPECT_LT(chain.levels[0].mesh.triangles.size(), chain.terrain.Triangles().size() / 2);
}

TEST(LodChain, IsTheSameOnASecondRun) {
  const Chain one = Build(FractalDem(5, 40), Budgets(10, 3));
  const Chain two = Build(FractalDem(5, 40), Budgets(10, 3));
  for (std::size_t i = 0; i < one.levels.size(); ++i) {
    EXPECT_EQ(one.levels[i].mesh.triangles, two.levels[i].mesh.triangles);
  }
}

// Posts on the column of `level`'s outline, as heights and rows, so that tiles can be compared.
std::vector<std::int32_t> RowsOnColumn(const Chain& tile, const Lod& level, std::int32_t column) {
  std::set<std::int32_t> rows;
  for (const Edge& edge : OutlineOf(level.mesh.triangles)) {
    for (const VertexId v : {edge.a, edge.b}) {
      if (tile.dem.Column(v) == column) rows.insert(tile.dem.Row(v));
    }
  }
  return {rows.begin(), rows.end()};
}

TEST(LodChain, TwoNeighboursMeetWithoutACrackAtEveryLevel) {
  for (std::uint32_t seed = 0; seed < 3; ++seed) {
    const Dem whole = FractalDem(6, 50 + seed);
    const auto tile = [&whole](std::int32_t first) {
      return DemOf(33, 33, [&](int c, int r) {
        return whole.heights[static_cast<std::size_t>((r + 16) * 65 + c + first)];
      });
    };
    const std::vector<LevelBudget> budgets = Budgets(10, 5);
    const Chain west = Build(tile(0), budgets);
    const Chain east = Build(tile(32), budgets);
    for (std::size_t i = 0; i < budgets.size(); ++i) {
      const std::vector<std::int32_t> rows = RowsOnColumn(west, west.levels[i], 32);
      EXPECT_EQ(rows, RowsOnColumn(east, east.levels[i], 0)) << "seed " << seed << ", level " << i;
      EXPECT_EQ(rows.size(), 33U);
    }
  }
}

TEST(RunsAlongOutline, IsFalseInsideTheTerrainAndAcrossAHole) {
  const Dem dem = DrawnDem(R"(
      1 1 1 1 1
      1 1 1 1 1
      1 1 . 1 1
      1 1 1 1 1
      1 1 1 1 1)");
  const Terrain terrain = *Terrain::Build(dem);
  EXPECT_TRUE(RunsAlongOutline(terrain, {0, 4}));
  EXPECT_TRUE(RunsAlongOutline(terrain, {4, 24}));
  EXPECT_FALSE(RunsAlongOutline(terrain, {5, 9}));    // within
  EXPECT_FALSE(RunsAlongOutline(terrain, {11, 13}));  // across the hole
  EXPECT_FALSE(RunsAlongOutline(terrain, {0, 9}));    // not along edges at all
  EXPECT_FALSE(RunsAlongOutline(terrain, {0, 24}));   // edges, with triangles on both sides
}

TEST(OutlinePosts, AreThoseOfSidesAndOfHoles) {
  const Dem dem = DrawnDem(R"(
      1 1 1 1 1 1
      1 1 1 1 1 1
      1 1 1 . 1 1
      1 1 1 1 1 1
      1 1 1 1 1 1
      1 1 1 1 1 1)");
  const Terrain terrain = *Terrain::Build(dem);
  std::set<VertexId> wanted;
  for (const Edge& edge : OutlineOf(terrain.Triangles())) {
    wanted.insert(edge.a);
    wanted.insert(edge.b);
  }
  const std::vector<bool> outline = OutlinePosts(terrain);
  for (VertexId v = 0; v < terrain.post_count(); ++v) {
    EXPECT_EQ(outline[static_cast<std::size_t>(v)], wanted.count(v) > 0) << "post " << v;
  }
  EXPECT_EQ(wanted.size(), 24U);  // 20 on the sides, 4 around the hole
}

}  // namespace
}  // namespace farhorizon

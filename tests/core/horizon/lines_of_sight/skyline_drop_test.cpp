#include "core/horizon/lines_of_sight/skyline_drop.h"

#include <cmath>
#include <filesystem>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "core/horizon/find_horizon.h"
#include "core/io/dem/read_dem.h"
#include "tests/oracles/horizon_brute_force.h"
#include "tests/support/ascii_dem.h"
#include "tests/support/effort.h"
#include "tests/support/terrains.h"

namespace farhorizon {
namespace {

// The tolerance is 1 / kUnits quanta.
constexpr int kUnits = 64;

// Every edge is visible over all others when it is lowered by a unit less than its skyline drop,
// and is not when lowered by a unit more.
testing::AssertionResult ArePrecise(const Dem& dem) {
  Result<Terrain> terrain = Terrain::Build(dem);
  if (!terrain) return testing::AssertionSuccess();
  const Horizon horizon = *FindHorizon(*terrain, {}, {});
  const SkylineDrops skyline_drops(*terrain, horizon, 1.0 / kUnits);
  const auto scaled = [&](VertexId v, std::int32_t lowered) {
    const Point3i p = terrain->Point(v);
    return Point3i{p.x, p.y, p.z * kUnits - lowered};
  };
  for (std::size_t i = 0; i < horizon.edges.size(); ++i) {
    const Edge edge = horizon.edges[i].edge;
    std::vector<Segment> others;
    for (const Edge e : terrain->Edges()) {
      if (e != edge) others.push_back({scaled(e.a, 0), scaled(e.b, 0)});
    }
    const auto is_visible = [&](std::int32_t depth) {
      const Segment lowered{scaled(edge.a, depth), scaled(edge.b, depth)};
      return LineOfSightByBruteForce(lowered, others, Ties::kPass).has_value();
    };
    const double units = skyline_drops.Of(i) * kUnits;
    const auto depth = static_cast<std::int32_t>(units);
    if (units != depth || depth < 0 || (depth > 0 && !is_visible(depth - 1)) ||
        is_visible(depth + 1)) {
      return testing::AssertionFailure() << DrawAscii(dem) << edge.a << '-' << edge.b << ": "
                                         << units << " / " << kUnits << " quanta";
    }
  }
  return testing::AssertionSuccess();
}

TEST(SkylineDrop, IsTheGreatestDepthAtWhichAnEdgeIsVisible) {
  std::mt19937 random(5);
  for (int i = 0; i < Rounds(1500); ++i) ASSERT_TRUE(ArePrecise(AnyRandomDem(3, 6, random)));
}

TEST(SkylineDrop, OfNamedTerrains) {
  for (const NamedTerrain& named : NamedTerrains()) {
    if (named.dem.columns * named.dem.rows > 81) continue;
    EXPECT_TRUE(ArePrecise(named.dem)) << named.name;
  }
}

TEST(SkylineDropLong, OfLandscapes) {
  std::mt19937 random(6);
  for (int i = 0; i < Rounds(60); ++i) ASSERT_TRUE(ArePrecise(AnyLandscape(8, 14, random)));
}

// A ridge of height 10 on a plain: some lines cross it as near to a post as you like, and otherwise
// the plain only.
TEST(SkylineDrop, OfARidgeOnAPlain) {
  const Dem dem = MakeDem(9, 5, [](std::int32_t column, std::int32_t row) {
    return row == 2 && column >= 3 && column <= 6 ? 10 : 0;
  });
  const Terrain terrain = *Terrain::Build(dem);
  const Horizon horizon = *FindHorizon(terrain, {}, {});
  const SkylineDrops skyline_drops(terrain, horizon, 1e-3);
  for (std::size_t i = 0; i < horizon.edges.size(); ++i) {
    if (horizon.edges[i].edge == MakeEdge(2 * 9 + 4, 2 * 9 + 5)) {
      EXPECT_LE(skyline_drops.Of(i), 10);
      EXPECT_GE(skyline_drops.Of(i), 10 - 1e-3);
    }
  }
}

// Heights with so great a range that steps are coarser than quanta.
TEST(SkylineDrop, OfGreatHeights) {
  const std::int32_t most = (1 << 30) - 1;
  const Dem dem = MakeDem(5, 5, [most](std::int32_t column, std::int32_t row) {
    return row == 2 ? most - column : -most + row;
  });
  const Terrain terrain = *Terrain::Build(dem);
  const Horizon horizon = *FindHorizon(terrain, {}, {});
  const SkylineDrops skyline_drops(terrain, horizon, 1e-3);
  double greatest = 0;
  for (std::size_t i = 0; i < horizon.edges.size(); ++i) {
    greatest = std::max(greatest, skyline_drops.Of(i));
  }
  EXPECT_GT(greatest, 0.9 * most);
  EXPECT_LE(greatest, 2.0 * most);
}

// On no line of a real DEM does the skyline drop by more where its edge is taken away.
TEST(SkylineDrop, IsNotExceededOnAnyLineOfADem) {
  const std::filesystem::path path = std::filesystem::path(FARHORIZON_DEM_DIR) / "zion_257.tif";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no zion_257.tif in FARHORIZON_DEM_DIR";
  const Dem dem = std::move(*ReadDem(path, {}));
  const Terrain terrain = *Terrain::Build(dem);
  const Horizon horizon = *FindHorizon(terrain, {.threads = 2}, {});
  const double tolerance = 1.0 / kUnits;
  const SkylineDrops skyline_drops(terrain, horizon, tolerance);
  const GridLineQuery lines(terrain);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0, 1);
  for (std::size_t i = 0; i < horizon.edges.size(); i += 50) {
    const Edge edge = horizon.edges[i].edge;
    const Point3i a = terrain.Point(edge.a);
    const Point3i b = terrain.Point(edge.b);
    const double skyline_drop = skyline_drops.Of(i);
    double greatest = 0;
    for (int k = 0; k < Rounds(500); ++k) {
      const double t = share(random);
      const double angle = 3.141592653589793 * share(random);
      const std::optional<HighestEdge> other = lines.HighestEdgeOver(
          edge, a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), std::cos(angle), std::sin(angle));
      if (other) greatest = std::max(greatest, a.z + t * (b.z - a.z) - other->height);
    }
    EXPECT_LE(greatest, skyline_drop + tolerance) << edge.a << '-' << edge.b;
  }
}

}  // namespace
}  // namespace farhorizon

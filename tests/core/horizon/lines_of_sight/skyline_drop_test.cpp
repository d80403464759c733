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

// By how much a drop may be too small.
double Tolerated(double tolerance, double drop) {
  return std::max(tolerance, SkylineDrops::kRelativeTolerance * drop) * (1 + 1e-9);
}

// Every edge is visible over all others when it is lowered by its skyline drop, and is not when it
// is lowered by the tolerance more. The depths that are tried are whole units, 2^-unit_bits quanta.
testing::AssertionResult ArePrecise(const Dem& dem, double tolerance, int unit_bits) {
  Result<Terrain> terrain = Terrain::Build(dem);
  if (!terrain) return testing::AssertionSuccess();
  const Horizon horizon = *FindHorizon(*terrain, {}, {});
  const SkylineDrops skyline_drops(*terrain, horizon, tolerance);
  const auto scaled = [&](VertexId v, std::int32_t lowered) {
    const Point3i p = terrain->Point(v);
    return Point3i{p.x, p.y, p.z * (1 << unit_bits) - lowered};
  };
  for (std::size_t i = 0; i < horizon.edges.size(); ++i) {
    const Edge edge = horizon.edges[i].edge;
    std::vector<Segment> others;
    for (const Edge e : terrain->Edges()) {
      if (e != edge) others.push_back({scaled(e.a, 0), scaled(e.b, 0)});
    }
    const auto is_visible = [&](double quanta) {
      const auto depth = static_cast<std::int32_t>(quanta);
      const Segment lowered{scaled(edge.a, depth), scaled(edge.b, depth)};
      return LineOfSightByBruteForce(lowered, others, Ties::kPass).has_value();
    };
    const double drop = skyline_drops.Of(i);
    const double units = std::ldexp(drop, unit_bits);
    const double beyond = std::ldexp(
        drop + std::max(Tolerated(tolerance, drop), std::ldexp(1.0, -unit_bits)), unit_bits);
    // Lowered by exactly the drop, an edge may touch others on all lines.
    if (drop < 0 || (units >= 1 && !is_visible(std::ceil(units) - 1)) ||
        is_visible(std::ceil(beyond))) {
      return testing::AssertionFailure()
             << DrawAscii(dem) << edge.a << '-' << edge.b << ": " << drop << " quanta";
    }
  }
  return testing::AssertionSuccess();
}

testing::AssertionResult ArePrecise(const Dem& dem) { return ArePrecise(dem, 1.0 / 64, 6); }

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

// Where quanta are finer than the tolerance, heights stay as they are: they were rounded to
// multiples of it, and drops were up to half a tolerance too great, or nearly two too small.
TEST(SkylineDrop, OfHeightsThatAreFinerThanTheTolerance) {
  std::mt19937 random(8);
  for (int i = 0; i < Rounds(300); ++i) {
    const auto most = static_cast<std::int32_t>(1000 << (random() % 12));
    const Dem dem =
        MakeDem(3 + static_cast<std::int32_t>(random() % 3), 4, [&](std::int32_t, std::int32_t) {
          return static_cast<std::int32_t>(random() % static_cast<std::uint32_t>(most));
        });
    ASSERT_TRUE(ArePrecise(dem, 1 + static_cast<double>(random() % 300), 0));
  }
}

// Heights with the whole range that a DEM admits: the lowered edge is below all of them.
TEST(SkylineDrop, OfTheWholeRangeOfHeights) {
  std::mt19937 random(9);
  constexpr std::int32_t kMost = (1 << 30) - 1;
  for (int i = 0; i < Rounds(200); ++i) {
    const Dem dem =
        MakeDem(3, 3 + static_cast<std::int32_t>(random() % 2), [&](std::int32_t, std::int32_t) {
          const auto little = static_cast<std::int32_t>(random() % 1000);
          return random() % 2 == 0 ? kMost - little : little - kMost;
        });
    const Terrain terrain = *Terrain::Build(dem);
    const Horizon horizon = *FindHorizon(terrain, {}, {});
    const SkylineDrops skyline_drops(terrain, horizon, 100);
    const GridLineQuery lines(terrain);
    std::uniform_real_distribution<double> share(0, 1);
    for (std::size_t k = 0; k < horizon.edges.size(); ++k) {
      const Edge edge = horizon.edges[k].edge;
      const Point3i a = terrain.Point(edge.a);
      const Point3i b = terrain.Point(edge.b);
      const double drop = skyline_drops.Of(k);
      ASSERT_GE(drop, 0);
      ASSERT_LE(drop, 2.0 * kMost);
      for (int shot = 0; shot < 20; ++shot) {
        const double t = share(random);
        const double angle = 3.141592653589793 * share(random);
        const std::optional<HighestEdge> other = lines.HighestEdgeOver(
            edge, {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), std::cos(angle), std::sin(angle)});
        const double clearance =
            other ? a.z + t * (static_cast<double>(b.z) - a.z) - other->height : 0;
        ASSERT_LE(clearance, drop + Tolerated(100, clearance) + 2 * lines.HeightError())
            << DrawAscii(dem) << edge.a << '-' << edge.b;
      }
    }
  }
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
      EXPECT_GE(skyline_drops.Of(i), 10 - Tolerated(1e-3, 10));
    }
  }
}

// Heights with so great a range that steps are no finer than quanta.
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
  const double tolerance = 1.0 / 64;
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
          edge, {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), std::cos(angle), std::sin(angle)});
      if (other) greatest = std::max(greatest, a.z + t * (b.z - a.z) - other->height);
    }
    EXPECT_LE(greatest, skyline_drop + Tolerated(tolerance, greatest)) << edge.a << '-' << edge.b;
  }
}

}  // namespace
}  // namespace farhorizon

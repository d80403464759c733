#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "core/horizon/horizon.h"
#include "core/horizon/horizon_kinetic.h"
#include "tests/support/effort.h"
#include "tests/support/matchers.h"
#include "tests/support/terrains.h"

namespace farhorizon {
namespace {

std::vector<Edge> Find(const Terrain& terrain) { return (*FindHorizonKinetic(terrain, {})).edges; }

Dem NthDem(std::int32_t columns, std::int32_t rows, std::int32_t levels, std::int32_t n) {
  return MakeDem(columns, rows, [&](std::int32_t, std::int32_t) {
    const std::int32_t height = n % levels;
    n /= levels;
    return height;
  });
}

TEST(FindHorizonKinetic, FindsTheKnownHorizonsOfTheNamedTerrains) {
  for (const NamedTerrain& named : NamedTerrains()) {
    EXPECT_TRUE(MatchesBruteForce(named.dem, Find)) << named.name;
  }
}

TEST(FindHorizonKinetic, FollowsTheDefinitionOnEverySeventhTerrainOfThreeByThreePosts) {
  for (std::int32_t n = 0; n < 19683; n += 7) {
    ASSERT_TRUE(MatchesBruteForce(NthDem(3, 3, 3, n), Find)) << "number " << n;
  }
}

TEST(FindHorizonKinetic, FollowsTheDefinitionOnRandomTerrains) {
  std::mt19937 random(1);
  for (int round = 0; round < Rounds(500); ++round) {
    ASSERT_TRUE(MatchesBruteForce(AnyRandomDem(3, 6, random), Find)) << "round " << round;
  }
}

}  // namespace
}  // namespace farhorizon

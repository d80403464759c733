#include "tests/support/matchers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/oracles/horizon_brute_force.h"
#include "tests/support/ascii_dem.h"
#include "tests/support/terrains.h"

namespace farhorizon {
namespace {

std::vector<Edge> AllButTheLast(const Terrain& terrain) {
  std::vector<Edge> edges = HorizonByBruteForce(terrain);
  edges.pop_back();
  return edges;
}

TEST(AsciiDem, IsDrawnAsItWasRead) {
  const Dem dem = AsciiDem("1 . -30\n0 2 5\n");
  EXPECT_EQ(dem.heights, (std::vector<std::int32_t>{1, kNoHeight, -30, 0, 2, 5}));
  EXPECT_EQ(AsciiDem(DrawAscii(dem)).heights, dem.heights);
  EXPECT_EQ(AsciiDem("1.\n25").heights, (std::vector<std::int32_t>{1, kNoHeight, 2, 5}));
}

TEST(MatchesBruteForce, NamesWhatIsMissingOnTheSmallestDem) {
  const testing::AssertionResult result = MatchesBruteForce(Paraboloid(7, -1), AllButTheLast);
  ASSERT_FALSE(result);
  // Any surface will do, and the smallest is one triangle.
  EXPECT_THAT(result.message(), testing::HasSubstr("missing: 2-3\nextra: none"));
  EXPECT_THAT(result.message(), testing::HasSubstr(".svg"));
}

TEST(MaximiserIsIn, FailsWhereAnEdgeOfTheHorizonIsLeftOut) {
  const Dem dem = AsciiDem(".0.\n010\n.0.");
  const Terrain terrain = *Terrain::Build(dem);
  EXPECT_TRUE(MaximiserIsIn(terrain, HorizonByBruteForce(terrain), 1'000, 1));
  EXPECT_FALSE(MaximiserIsIn(terrain, AllButTheLast(terrain), 1'000, 1));
}

TEST(LineOfSightIsClear, TellsWhatStandsInTheWay) {
  const Segment low{{0, 0, 1}, {2, 0, 1}};
  const Segment wall{{0, 2, 2}, {2, 2, 2}};
  EXPECT_FALSE(LineOfSightIsClear({0.5, 0, 1}, low, {wall}, Ties::kPass));
  EXPECT_TRUE(LineOfSightIsClear({0.5, 2, 1}, low, {wall}, Ties::kPass))
      << "passes beside the wall";
  EXPECT_TRUE(LineOfSightIsClear({0.5, 0, 1}, wall, {low}, Ties::kBlock));
  EXPECT_FALSE(LineOfSightIsClear({0.5, 1, 0}, low, {}, Ties::kPass)) << "runs along the segment";
}

}  // namespace
}  // namespace farhorizon

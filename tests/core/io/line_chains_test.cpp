#include "core/io/line_chains.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace farhorizon {
namespace {

using ::testing::ElementsAre;
using Point = std::array<float, 3>;

TEST(LineChainsOf, PointsRunOnAndWeightsAreThoseOfTheDemsEdges) {
  const std::vector<LineChain> chains =
      LineChainsOf({{{{{10, 0, 7}, {0, 0, 5}}}, 1, 2.0F, 0.25F},
                    {{{{10, 0, 7}, {20, 1, 9}}}, 8, std::nullopt, std::nullopt},
                    {{{{20, 1, 9}, {30, 1, 3}}}, 8, 0.5F, 4.0F}});
  ASSERT_EQ(chains.size(), 1U);
  EXPECT_THAT(chains[0].points,
              ElementsAre(Point{0, 0, 5}, Point{10, 0, 7}, Point{20, 1, 9}, Point{30, 1, 3}));
  EXPECT_EQ(chains[0].azimuths, 9U);
  EXPECT_EQ(chains[0].line_measure_m, 2.5F);
  EXPECT_EQ(chains[0].skyline_drop_m, 4.0F);
}

TEST(LineChainsOf, AChainOfChordsHasNoWeights) {
  const std::vector<LineChain> chains =
      LineChainsOf({{{{{0, 0, 0}, {1, 0, 0}}}, 1, std::nullopt, std::nullopt},
                    {{{{5, 0, 0}, {6, 0, 0}}}, 1, 0.0F, std::nullopt}});
  ASSERT_EQ(chains.size(), 2U);
  EXPECT_FALSE(chains[0].line_measure_m);
  EXPECT_EQ(chains[1].line_measure_m, 0.0F);
  EXPECT_FALSE(chains[1].skyline_drop_m);
}

}  // namespace
}  // namespace farhorizon

#include "core/io/join_edges.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace farhorizon {
namespace {

using ::testing::ElementsAre;

TEST(JoinEdges, TheStraightestAreJoinedAndRunOneWay) {
  // A line from the left that bends by little, with an edge upright at its bend.
  const auto chains = JoinEdges({{{10, 0}, {0, 0}}, {{10, 0}, {10, 8}}, {{10, 0}, {20, 1}}});
  ASSERT_EQ(chains.size(), 2U);
  EXPECT_THAT(chains[0], ElementsAre(ChainedEdge{0, true}, ChainedEdge{2, false}));
  EXPECT_THAT(chains[1], ElementsAre(ChainedEdge{1, false}));
}

TEST(JoinEdges, UnlikeKindsAreNotJoined) {
  EXPECT_EQ(JoinEdges({{{0, 0}, {1, 0}, 0}, {{1, 0}, {2, 0}, 1}}).size(), 2U);
  EXPECT_EQ(JoinEdges({{{0, 0}, {1, 0}, 1}, {{1, 0}, {2, 0}, 1}}).size(), 1U);
}

TEST(JoinEdges, ARingIsOneChainAfterThoseThatEnd) {
  const auto chains = JoinEdges(
      {{{0, 0}, {1, 0}}, {{1, 0}, {0, 1}}, {{0, 1}, {0, 0}}, {{5, 5}, {6, 5}}, {{7, 5}, {6, 5}}});
  ASSERT_EQ(chains.size(), 2U);
  EXPECT_THAT(chains[0], ElementsAre(ChainedEdge{3, false}, ChainedEdge{4, true}));
  EXPECT_EQ(chains[1].size(), 3U);
}

}  // namespace
}  // namespace farhorizon

#include "core/terrain/part_grid.h"

#include <vector>

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

// The posts at which a side is cut: its middle, the middles of both halves, and so on.
void Halve(std::int64_t first, std::int64_t last, std::int64_t posts, int depth,
           std::vector<bool>& cut) {
  if (depth == 0) return;
  // The halves' ends are whole parts of what the whole side's cells are.
  const std::int64_t middle = (first + last) / 2;
  cut[static_cast<std::size_t>(middle * (posts - 1) / 16)] = true;
  Halve(first, middle, posts, depth - 1, cut);
  Halve(middle, last, posts, depth - 1, cut);
}

TEST(PartGrid, IsCutWhereHalvingCuts) {
  for (std::int64_t posts = 33; posts < 200; ++posts) {
    for (int depth = 0; depth <= kMostPartDepth; ++depth) {
      std::vector<bool> cut(static_cast<std::size_t>(posts), false);
      Halve(0, 16, posts, depth, cut);
      for (std::int64_t i = 0; i < posts; ++i) {
        ASSERT_EQ(PartGrid::IsCutAt(i, posts, depth), cut[static_cast<std::size_t>(i)])
            << i << " of " << posts << " at depth " << depth;
      }
    }
  }
}

TEST(PartGrid, SeesEveryEdgeThatCrossesALineAndNoOther) {
  const PartGrid grid(41, 70, {2, 3});
  const auto crosses = [](int p, int q, int posts, int depth) {
    for (int i = 0; i < posts; ++i) {
      if (PartGrid::IsCutAt(i, posts, depth) && (p - i) * (q - i) < 0) return true;
    }
    return false;
  };
  for (int x = 0; x < 41; ++x) {
    for (int y = 0; y < 70; ++y) {
      for (const int to_y : {0, 17, 35, 69}) {
        const int to_x = (7 * x + y) % 41;
        ASSERT_EQ(grid.IsCrossedBy(x, y, to_x, to_y),
                  crosses(x, to_x, 41, 2) || crosses(y, to_y, 70, 3));
      }
      EXPECT_EQ(grid.IsOnLine(x, y), PartGrid::IsCutAt(x, 41, 2) || PartGrid::IsCutAt(y, 70, 3));
    }
  }
  EXPECT_FALSE(PartGrid(41, 70, {}).IsCrossedBy(0, 0, 40, 69));
  EXPECT_FALSE(PartGrid().IsCrossedBy(0, 0, 40, 69));
}

TEST(PartGrid, PartsAreCountedFromTheFirstColumnAndRow) {
  const PartGrid grid(41, 70, {2, 1});
  EXPECT_EQ(grid.ColumnPart(0), 0);
  EXPECT_EQ(grid.ColumnPart(9), 0);
  EXPECT_EQ(grid.ColumnPart(10), 1);
  EXPECT_EQ(grid.ColumnPart(39), 3);
  EXPECT_EQ(grid.RowPart(33), 0);
  EXPECT_EQ(grid.RowPart(34), 1);
}

TEST(PartDepthFor, HalvesUntilAPartIsSmallEnoughOrSidesAllowNoMore) {
  EXPECT_EQ(PartDepthFor(20000, 20000, {4, 4}), (PartDepth{0, 0}));
  EXPECT_EQ(PartDepthFor(20001, 20000, {4, 4}), (PartDepth{1, 1}));
  EXPECT_EQ(PartDepthFor(80001, 20000, {4, 4}), (PartDepth{2, 2}));
  EXPECT_EQ(PartDepthFor(80001, 20000, {4, 0}), (PartDepth{3, 0}));
  EXPECT_EQ(PartDepthFor(1'000'000'000, 20000, {2, 3}), (PartDepth{2, 3}));
  EXPECT_EQ(PartDepthFor(1'000'000'000, 0, {4, 4}), (PartDepth{0, 0}));
}

TEST(SidePartDepth, EachPieceHasThirtyTwoOfTheStayingPosts) {
  EXPECT_EQ(SidePartDepth(63, 1), 0);
  EXPECT_EQ(SidePartDepth(64, 1), 1);
  EXPECT_EQ(SidePartDepth(403, 1), 3);
  EXPECT_EQ(SidePartDepth(403, 0.2), 1);
  EXPECT_EQ(SidePartDepth(1'000'000, 1), kMostPartDepth);
}

}  // namespace
}  // namespace farhorizon

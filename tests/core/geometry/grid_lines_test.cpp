#include "core/geometry/grid_lines.h"

#include <set>

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

TEST(GridLines, HaveEveryPostOfTheGridOnceInEachFamily) {
  constexpr std::int32_t kColumns = 5;
  constexpr std::int32_t kRows = 3;
  for (const GridLines& family : FamiliesOfGridLines(kColumns, kRows)) {
    std::set<Point2i> posts;
    for (std::int32_t i = family.first; i <= family.last; ++i) {
      bool has_posts = false;
      for (std::int32_t j = -kColumns - kRows; j <= kColumns + kRows; ++j) {
        const Point2i p = family.Post(i, j);
        if (p.x < 0 || p.x >= kColumns || p.y < 0 || p.y >= kRows) continue;
        EXPECT_TRUE(posts.insert(p).second);
        has_posts = true;
      }
      EXPECT_TRUE(has_posts) << "line " << i;
    }
    EXPECT_EQ(posts.size(), std::size_t{kColumns} * kRows);
  }
}

TEST(GridLines, FindPostsByTheirPosition) {
  for (const GridLines& family : FamiliesOfGridLines(4, 4)) {
    for (std::int32_t i = family.first; i <= family.last; ++i) {
      for (std::int32_t j = -8; j <= 8; ++j) {
        const Point2i p = family.Post(i, j);
        const auto exact = family.PositionOf<std::int64_t>(p.x, p.y);
        EXPECT_EQ(exact.i, i);
        EXPECT_EQ(exact.j, j);
        const auto rounded = family.PositionOf<double>(p.x, p.y);
        EXPECT_EQ(rounded.i, i);
        EXPECT_EQ(rounded.j, j);
      }
    }
  }
}

TEST(GridLines, JoinNeighboursInFourDirections) {
  const auto families = FamiliesOfGridLines(9, 9);
  const auto along = [&families](std::size_t k) {
    return Point2i{families[k].along_column, families[k].along_row};
  };
  EXPECT_EQ(along(0), (Point2i{1, 0}));
  EXPECT_EQ(along(1), (Point2i{0, 1}));
  EXPECT_EQ(along(2), (Point2i{1, 1})) << "cells are split along it";
  EXPECT_EQ(along(3), (Point2i{-1, 1}));
}

}  // namespace
}  // namespace farhorizon

#include "core/io/text_grid/grid_lines.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace farhorizon {
namespace {

using ::testing::HasSubstr;

// What is said of lines of these many cells, for a header of columns x rows: "", or the error.
std::string Judged(std::int64_t columns, std::int64_t rows, const std::vector<int>& lines) {
  GridLines shape(columns);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    for (int cell = 0; cell < lines[i]; ++cell) shape.Take(static_cast<std::int64_t>(i) + 7);
  }
  Status judged = shape.Judge(rows);
  if (judged) return "";
  return std::string(judged.error().kind) + ": " + judged.error().message;
}

TEST(GridLines, TakesARowALine) { EXPECT_EQ(Judged(3, 4, {3, 3, 3, 3}), ""); }

TEST(GridLines, TakesRowsThatAreWrapped) {
  EXPECT_EQ(Judged(4, 3, {2, 2, 2, 2, 2, 2}), "");
  EXPECT_EQ(Judged(4, 3, {12}), "");
  EXPECT_EQ(Judged(4, 4, {8, 8}), "");
  EXPECT_EQ(Judged(4, 3, std::vector<int>(12, 1)), "");
  EXPECT_EQ(Judged(7, 3, {5, 2, 5, 2, 5, 2}), "");  // each row wrapped by itself
  EXPECT_EQ(Judged(7, 3, {5, 5, 5, 5, 1}), "");     // all cells in lines of five
}

TEST(GridLines, RefusesAShearedGrid) {
  const std::string said = Judged(18, 23, std::vector<int>(23, 19));
  EXPECT_THAT(said, HasSubstr("not-a-raster: header and body"));
  EXPECT_THAT(said, HasSubstr("ncols is 18"));
  EXPECT_THAT(said, HasSubstr("line 7 has 19"));
  EXPECT_THAT(Judged(20, 23, std::vector<int>(23, 19)), HasSubstr("not-a-raster"));
}

TEST(GridLines, RefusesColumnsAndRowsThatAreExchanged) {
  EXPECT_THAT(Judged(23, 19, std::vector<int>(23, 19)), HasSubstr("not-a-raster"));
  EXPECT_THAT(Judged(20, 10, std::vector<int>(20, 10)), HasSubstr("not-a-raster"));
}

TEST(GridLines, RefusesLinesOfAnotherGridOfAsManyCells) {
  EXPECT_THAT(Judged(4, 9, std::vector<int>(6, 6)), HasSubstr("not-a-raster"));
}

TEST(GridLines, RefusesACellThatHasSlippedIntoTheNextLine) {
  const std::string said = Judged(3, 4, {3, 2, 4, 3});
  EXPECT_THAT(said, HasSubstr("line 8 has 2"));
}

TEST(GridLines, RefusesMoreCellsThanTheHeaderSays) {
  EXPECT_THAT(Judged(3, 4, {3, 3, 3, 3, 3}), HasSubstr("15 cells in 5 lines"));
  EXPECT_THAT(Judged(3, 4, {3, 3, 3, 3, 1}), HasSubstr("line 11 has 1"));
}

TEST(GridLines, SaysWhatIsCutShort) {
  EXPECT_THAT(Judged(3, 4, {3, 3}), HasSubstr("truncated"));
  EXPECT_THAT(Judged(3, 4, {3, 3, 3, 2}), HasSubstr("11 of its 12 cells"));
  EXPECT_THAT(Judged(3, 4, {}), HasSubstr("truncated"));
  EXPECT_THAT(Judged(6, 4, {3, 3, 3, 3, 3, 2}), HasSubstr("truncated"));
}

}  // namespace
}  // namespace farhorizon

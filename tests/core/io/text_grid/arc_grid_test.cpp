#include "core/io/text_grid/arc_grid.h"

#include <bit>
#include <cmath>
#include <cstring>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsNan;

constexpr char kHeader[] = "ncols 3\nnrows 2\nxllcorner 10\nyllcorner 20\ncellsize 2\n";

class ArcGrid : public ::testing::Test {
 protected:
  Result<TextGrid> Read(const std::string& text) {
    SpillFile(dir_ / "dem.asc", text);
    return ReadArcGrid(dir_ / "dem.asc", {1000});
  }
  TextGrid MustRead(const std::string& text) {
    Result<TextGrid> grid = Read(text);
    if (!grid) throw std::runtime_error(grid.error().message);
    return *grid;
  }
  std::string Refusal(const std::string& text) {
    Result<TextGrid> grid = Read(text);
    return grid ? "read" : std::string(grid.error().kind) + ": " + grid.error().message;
  }

  TempDir dir_;
};

std::vector<double> Values(const TextGrid& grid) {
  std::vector<double> values;
  for (std::size_t i = 0; i < grid.cells.size(); ++i) {
    std::int32_t bits = 0;
    std::memcpy(&bits, static_cast<const char*>(grid.cells.data()) + 4 * i, 4);
    values.push_back(grid.cells.is_float() ? static_cast<double>(std::bit_cast<float>(bits))
                                           : bits);
  }
  return values;
}

std::string With(const std::string& line, const std::string& instead) {
  std::string header = kHeader;
  return header.replace(header.find(line), line.size(), instead) + "1 2 3\n4 5 6\n";
}

TEST_F(ArcGrid, ReadsCellsAndPlace) {
  const TextGrid grid = MustRead(std::string(kHeader) + "NODATA_value -9999\n1 2 3\n4 -9999 6\n");
  EXPECT_EQ(grid.columns, 3);
  EXPECT_EQ(grid.rows, 2);
  EXPECT_FALSE(grid.cells.is_float());
  EXPECT_THAT(Values(grid), ElementsAre(1, 2, 3, 4, -9999, 6));
  EXPECT_THAT(grid.geotransform, ElementsAre(10, 2, 0, 24, 0, -2));
  EXPECT_EQ(grid.nodata, -9999);
}

TEST_F(ArcGrid, BecomesFloatsAtTheFirstThatIsNoInteger) {
  const TextGrid grid = MustRead(std::string(kHeader) + "1 2 -3\n4.5 5e0 6\n");
  EXPECT_TRUE(grid.cells.is_float());
  EXPECT_THAT(Values(grid), ElementsAre(1, 2, -3, 4.5, 5, 6));
}

TEST_F(ArcGrid, ReadsCentresUnequalSidesAndAnyOrder) {
  const TextGrid grid =
      MustRead("  NROWS 2\nDX 2\nDY 4\nYLLCENTER 20\nXLLCORNER 10\nNCOLS 3\n1 2 3\n4 5 6\n");
  EXPECT_THAT(grid.geotransform, ElementsAre(10, 2, 0, 26, 0, -4));
}

TEST_F(ArcGrid, ReadsLinesHoweverTheyEnd) {
  for (const char* end : {"\n", "\r\n", "\r", " \t\n\n"}) {
    std::string text;
    for (const char* line : {"ncols 3", "nrows 2", "xllcorner 10", "yllcorner 20", "cellsize 2",
                             "1\t2  3", " 4 5 6"}) {
      text += line + std::string(end);
    }
    EXPECT_THAT(Values(MustRead(text)), ElementsAre(1, 2, 3, 4, 5, 6));
    EXPECT_THAT(Values(MustRead("\xef\xbb\xbf" + text + "\x1a")), ElementsAre(1, 2, 3, 4, 5, 6));
  }
}

TEST_F(ArcGrid, ReadsDecimalCommasAndFortransExponents) {
  EXPECT_THAT(Values(MustRead(std::string(kHeader) + "1,5 2 3,25\n4 5 6\n")),
              ElementsAre(1.5, 2, 3.25, 4, 5, 6));
  EXPECT_THAT(Values(MustRead(std::string(kHeader) + "1.5D+01 2 3\n4 5 6\n")),
              ElementsAre(15, 2, 3, 4, 5, 6));
  EXPECT_EQ(MustRead(With("xllcorner 10", "xllcorner 10,5")).geotransform[0], 10.5);
}

TEST_F(ArcGrid, AWordThatTheHeaderNamesHasNoData) {
  for (const char* word : {"NA", "null", "-", "#N/A", "*"}) {
    const TextGrid grid = MustRead(std::string(kHeader) + "NODATA_value " + word + "\n" + word +
                                   " 2 3\n4 5 " + word + "\n");
    EXPECT_THAT(Values(grid), ElementsAre(IsNan(), 2, 3, 4, 5, IsNan())) << word;
    EXPECT_FALSE(grid.nodata);
  }
  EXPECT_THAT(Values(MustRead(std::string(kHeader) + "nan 2 -1.#IND\n4 5 1.#QNAN\n")),
              ElementsAre(IsNan(), 2, IsNan(), 4, 5, IsNan()));
}

TEST_F(ArcGrid, RefusesAnyOtherWordWithItsPlace) {
  const std::string said = Refusal(std::string(kHeader) + "NODATA_value -9999\n1 2 3\n4 NA 6\n");
  EXPECT_THAT(said, HasSubstr("not-a-raster"));
  EXPECT_THAT(said, HasSubstr("\"NA\" in line 8, column 3"));
  EXPECT_THAT(said, HasSubstr("$i = \"-9999\""));
  EXPECT_THAT(Refusal(std::string(kHeader) + "1 2 3\n4 - 6\n"), HasSubstr("--nodata -9999"));
  EXPECT_THAT(Refusal(std::string(kHeader) + "NODATA_value NA\n1 2 3\n4 na 6\n"),
              HasSubstr("\"na\" in line 8, column 3"));
  EXPECT_THAT(Refusal(std::string(kHeader) + "1 2 3\n4 1,234.50 6\n"),
              HasSubstr("\"1,234.50\" in line 7"));
  for (const char* word : {"0x1F", "1e5e", "#N/A", "\xc3\xa9", "cellsize", "1;2"}) {
    EXPECT_THAT(Refusal(std::string(kHeader) + "1 2 3\n4 " + word + " 6\n"),
                HasSubstr("line 7, column 3"))
        << word;
  }
}

TEST_F(ArcGrid, RefusesThousands) {
  EXPECT_THAT(Refusal(std::string(kHeader) + "1,001 2 3\n4 5 6\n"), HasSubstr("\"1,001\""));
  EXPECT_THAT(Refusal(With("xllcorner 10", "xllcorner 420,000.00")),
              HasSubstr("\"420,000.00\" for xllcorner in line 3"));
  EXPECT_THAT(Refusal(With("xllcorner 10", "xllcorner 420,000")), HasSubstr("\"420,000\""));
}

TEST_F(ArcGrid, RefusesAHeaderThatLacksOrRepeats) {
  EXPECT_THAT(Refusal(With("xllcorner 10\n", "")), HasSubstr("no xllcorner (or xllcenter)"));
  EXPECT_THAT(Refusal(With("yllcorner 20\n", "")), HasSubstr("no yllcorner (or yllcenter)"));
  EXPECT_THAT(Refusal(With("cellsize 2\n", "dx 2\n")), HasSubstr("no cellsize (or dx and dy)"));
  EXPECT_THAT(Refusal(With("ncols 3\n", "")), HasSubstr("no ncols"));
  EXPECT_THAT(Refusal(With("nrows 2\n", "nrows 2\nnrows 3\n")), HasSubstr("nrows twice"));
  EXPECT_THAT(Refusal(With("nrows 2\n", "nrows\n")), HasSubstr("no value for nrows in line 2"));
  EXPECT_THAT(Refusal(With("cellsize 2\n", "cellsize 2\ndx 3\ndy 2\n")), HasSubstr("true one"));
  EXPECT_THAT(Refusal(With("cellsize 2\n", "cellsize 2\nxllcenter 12\n")), HasSubstr("true one"));
  EXPECT_EQ(Refusal(With("cellsize 2\n", "cellsize 2\nxllcenter 11\nnrows 2.0\n")), "read");
}

TEST_F(ArcGrid, RefusesAHeaderOfNoUse) {
  EXPECT_THAT(Refusal(With("cellsize 2", "cellsize 0")), HasSubstr("larger than 0"));
  EXPECT_THAT(Refusal(With("cellsize 2", "cellsize -2")), HasSubstr("larger than 0"));
  EXPECT_THAT(Refusal(With("cellsize 2", "cellsize nan")), HasSubstr("\"nan\""));
  EXPECT_THAT(Refusal(With("ncols 3", "ncols 3.5")), HasSubstr("\"3.5\" for ncols"));
  EXPECT_THAT(Refusal(With("ncols 3", "ncols -3")), HasSubstr("\"-3\" for ncols"));
  EXPECT_THAT(Refusal(With("ncols 3", "ncols three")), HasSubstr("\"three\" for ncols"));
  EXPECT_THAT(Refusal(With("cellsize 2", "cellsize 2\nrotation 5")), HasSubstr("\"rotation\""));
  EXPECT_THAT(Refusal(With("ncols 3", "ncols 40")), HasSubstr("disagree"));
  EXPECT_THAT(Refusal(With("ncols 3", "ncols 4000")), HasSubstr("raster-too-large"));
}

TEST_F(ArcGrid, RefusesWhatFollowsTheCells) {
  EXPECT_THAT(Refusal(std::string(kHeader) + "1 2 3\n4 5 6\nend\n"),
              HasSubstr("\"end\" in line 8, column 1, after its last cell"));
  EXPECT_THAT(Refusal("ncols: 3\nnrows: 2\n"), HasSubstr("\"ncols:\" in line 1"));
  EXPECT_THAT(Refusal(std::string(kHeader) + "1,2,3\n4,5,6\n"), HasSubstr("sed 's/,/ /g'"));
  EXPECT_THAT(Refusal(std::string(kHeader) + "1;2;3\n4;5;6\n"), HasSubstr("sed 's/;/ /g'"));
  EXPECT_THAT(Refusal(std::string(kHeader) + "1,234.5 2 3\n4 5 6\n"), HasSubstr("sed 's/,//g'"));
  EXPECT_THAT(Refusal(std::string(kHeader) + "1 2 3\n4 5 6\n7\n"), HasSubstr("line 8 has 1"));
}

}  // namespace
}  // namespace farhorizon

#include <bit>
#include <cstring>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/text_grid/esri_header.h"
#include "core/io/text_grid/grass_grid.h"
#include "core/io/text_grid/surfer_grid.h"
#include "core/io/text_grid/xyz_list.h"
#include "core/io/text_grid/xyz_points.h"
#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsNan;

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

class TextFormats : public ::testing::Test {
 protected:
  template <typename Read>
  auto Must(Read read, const std::string& text) {
    SpillFile(dir_ / "dem.txt", text);
    auto grid = read(dir_ / "dem.txt", GridLimits{1000});
    if (!grid) throw std::runtime_error(grid.error().message);
    return *grid;
  }
  template <typename Read>
  std::string Refusal(Read read, const std::string& text) {
    SpillFile(dir_ / "dem.txt", text);
    auto grid = read(dir_ / "dem.txt", GridLimits{1000});
    return grid ? "read" : std::string(grid.error().kind) + ": " + grid.error().message;
  }

  TempDir dir_;
};

constexpr char kGrass[] = "north: 24\nsouth: 20\neast: 16\nwest: 10\nrows: 2\ncols: 3\n";

TEST_F(TextFormats, ReadsGrassGrids) {
  const TextGrid grid = Must(ReadGrassGrid, kGrass + std::string("1 2 *\n4 5 6\n"));
  EXPECT_THAT(Values(grid), ElementsAre(1, 2, IsNan(), 4, 5, 6));
  EXPECT_THAT(grid.geotransform, ElementsAre(10, 2, 0, 24, 0, -2));
  EXPECT_EQ(Must(ReadGrassGrid, kGrass + std::string("null: -9\n1 2 -9\n4 5 6\n")).nodata, -9);
  EXPECT_THAT(Values(Must(ReadGrassGrid, kGrass + std::string("null: no\n1 2 no\n4 5 6\n"))),
              ElementsAre(1, 2, IsNan(), 4, 5, 6));
}

TEST_F(TextFormats, RefusesGrassGridsOfNoUse) {
  EXPECT_THAT(Refusal(ReadGrassGrid, kGrass + std::string("multiplier: 2\n1 2 3\n4 5 6\n")),
              HasSubstr("\"multiplier:\""));
  EXPECT_THAT(Refusal(ReadGrassGrid, "north: 1\nsouth: 2\neast: 2\nwest: 1\nrows: 2\ncols: 2\n"),
              HasSubstr("wrong way round"));
  EXPECT_THAT(Refusal(ReadGrassGrid,
                      "north: 46:30N\nsouth: 2\neast: 2\nwest: 1\nrows: 2\n"
                      "cols: 2\n1 2 3 4\n"),
              HasSubstr("\"46:30N\" for north:"));
  EXPECT_THAT(Refusal(ReadGrassGrid, kGrass + std::string("1 2 3 9\n4 5 6 9\n")),
              HasSubstr("disagree"));
}

TEST_F(TextFormats, ReadsSurferGridsFromTheSouth) {
  const TextGrid grid =
      Must(ReadSurferGrid, "DSAA\n3 2\n10 14\n20 22\n1 6\n1 2 3\n4 5\n1.70141e+038\n");
  EXPECT_EQ(grid.columns, 3);
  EXPECT_THAT(grid.geotransform, ElementsAre(9, 2, 0, 23, 0, -2));
  EXPECT_THAT(std::vector<double>(Values(grid)).front(), 4);
  EXPECT_EQ(Values(grid)[3], 1);
  EXPECT_NEAR(Values(grid)[2] / *grid.nodata, 1, 1e-6);
}

TEST_F(TextFormats, RefusesSurferGridsOfNoUse) {
  EXPECT_THAT(Refusal(ReadSurferGrid, "DSAA\n3 x\n"), HasSubstr("the number of rows"));
  EXPECT_THAT(Refusal(ReadSurferGrid, "DSAA\n3 2\n14 10\n20 22\n1 6\n1 2 3\n4 5 6\n"),
              HasSubstr("makes no grid"));
  EXPECT_THAT(Refusal(ReadSurferGrid, "DSAA\n3 2\n10"), HasSubstr("ends before the last x"));
  EXPECT_THAT(Refusal(ReadSurferGrid, "DSAA\n3 2\n10 14\n20 22\n1 6\n1 2 3\n4 5\n"),
              HasSubstr("truncated"));
  EXPECT_THAT(Refusal(ReadSurferGrid, "DSAA\n3 2\n10 14\n20 22\n1 6\n1 2 3\n4 - 6\n"),
              HasSubstr("\"-\" in line 7, column 3"));
}

TEST_F(TextFormats, ReadsListsInAnyOrder) {
  for (const char* text :
       {"10 20 1\n12 20 2\n14 20 3\n10 22 4\n12 22 5\n14 22 6\n",
        "10 22 4\n12 22 5\n14 22 6\n10 20 1\n12 20 2\n14 20 3\n",
        "10 20 1\n10 22 4\n12 20 2\n12 22 5\n14 20 3\n14 22 6\n",
        "14;22;6\r\n10;20;1\r\n12;20;2\r\n14;20;3\r\n10;22;4\r\n12;22;5\r\n",
        "X, Y, Z\n10,20,1\n12,20,2\n14,20,3\n10,22,4\n12,22,5\n14,22,6\n",
        "Easting,Northing,Elevation (m)\n10,20,1\n12,20,2\n14,20,3\n10,22,4\n12,22,5\n14,22,6\n",
        "# x y z\n10 20 1\n12 20 2\n14 20 3\n10 22 4\n12 22 5\n14 22 6\n",
        "lat lon height\n20 10 1\n20 12 2\n20 14 3\n22 10 4\n22 12 5\n22 14 6"}) {
    const XyzGrid list = Must(ReadXyzList, text);
    EXPECT_THAT(Values(list.grid), ElementsAre(4, 5, 6, 1, 2, 3)) << text;
    EXPECT_THAT(list.grid.geotransform, ElementsAre(9, 2, 0, 23, 0, -2)) << text;
  }
}

TEST_F(TextFormats, CellsThatAListLeavesOutHaveNoData) {
  const XyzGrid list = Must(ReadXyzList, "10 20 1\n14 20 3\n10 22 4\n12 22 5\n14 22 nan\n");
  EXPECT_THAT(Values(list.grid), ElementsAre(4, 5, IsNan(), 1, IsNan(), 3));
}

TEST_F(TextFormats, ReadsPlacesThatAreRounded) {
  std::string text;
  for (int row = 0; row < 30; ++row) {
    for (int column = 0; column < 30; ++column) {
      char line[64];
      std::snprintf(line, sizeof line, "%.5f %.5f %d\n", 7 + column / 3600.0, 46 - row / 3600.0,
                    row * 30 + column);
      text += line;
    }
  }
  const XyzGrid list = Must(ReadXyzList, text);
  EXPECT_EQ(list.grid.columns, 30);
  EXPECT_EQ(Values(list.grid)[31], 31);
  EXPECT_NEAR(list.grid.geotransform[1], 1 / 3600.0, 1e-6);
}

TEST_F(TextFormats, RefusesListsThatAreNoGrid) {
  EXPECT_THAT(Refusal(ReadXyzList, "10 20 1\n12 20 2\n15 20 3\n10 22 4\n12 22 5\n14 22 6\n"),
              HasSubstr("lies between the cells"));
  EXPECT_THAT(Refusal(ReadXyzList, "10 20 1\n12 20 2\n10 20 3\n12 22 4\n"),
              HasSubstr("line 3 twice"));
  EXPECT_THAT(Refusal(ReadXyzList, "1 1 1\n2 2 1\n9 9 1\n"), HasSubstr("gdal_grid"));
  EXPECT_THAT(Refusal(ReadXyzList, "10 20 1\n12 20 2\n"), HasSubstr("two rows and columns"));
  EXPECT_THAT(Refusal(ReadXyzList, "10 20 1\n12 20\n10 22 3\n"), HasSubstr("2 numbers in line 2"));
  EXPECT_THAT(Refusal(ReadXyzList, "10 20 1 5\n12 20 2 5\n"), HasSubstr("a fourth column"));
  EXPECT_THAT(Refusal(ReadXyzList, "10 20 NA\n12 20 2\n"), HasSubstr("\"NA\" in line 1, column 7"));
  EXPECT_THAT(Refusal(ReadXyzList, "x y colour\n10 20 1\n"), HasSubstr("column \"colour\""));
  EXPECT_THAT(Refusal(ReadXyzList, "x y x\n10 20 1\n"), HasSubstr("column \"x\""));
  EXPECT_THAT(Refusal(ReadXyzList, "x y z(ft)\n10 20 1\n"), HasSubstr("--height-unit"));
}

TEST(LooksLikeXyz, WantsTwoLinesOfThreeNumbers) {
  EXPECT_TRUE(LooksLikeXyz("1 2 3\n2 2 3\n"));
  EXPECT_TRUE(LooksLikeXyz("x;y;z\n1;2;3\n2;2;3\n"));
  EXPECT_FALSE(LooksLikeXyz("1 2 3\n"));
  EXPECT_FALSE(LooksLikeXyz("hello big world\nof many words\n"));
  EXPECT_FALSE(LooksLikeXyz("1 2 3 4\n1 2 3 4\n"));
  EXPECT_FALSE(LooksLikeXyz(""));
  EXPECT_FALSE(LooksLikeXyz("1 2 3"));
}

class EsriHeader : public ::testing::Test {
 protected:
  std::string Said(const std::string& header, std::int64_t bytes) {
    SpillFile(dir_ / "dem.hdr", header);
    Status sound = CheckEsriHeader(dir_ / "dem.hdr", bytes);
    return sound ? "sound" : std::string(sound.error().kind) + ": " + sound.error().message;
  }
  std::string With(const std::string& line, const std::string& instead, std::int64_t bytes) {
    std::string header =
        "NROWS 2\nNCOLS 3\nNBANDS 1\nNBITS 16\nBYTEORDER I\nLAYOUT BIL\nBANDROWBYTES 6\n"
        "ULXMAP 10\nULYMAP 20\nXDIM 2\nYDIM 2\nNODATA -9999\nNAME of a place\n";
    if (!line.empty()) header.replace(header.find(line), line.size(), instead);
    return Said(header, bytes);
  }

  TempDir dir_;
};

TEST_F(EsriHeader, TakesWhatIsWhole) {
  EXPECT_EQ(With("", "", 12), "sound");
  EXPECT_EQ(With("NBITS 16\n", "", 12), "sound");
  EXPECT_EQ(With("LAYOUT BIL\n", "SKIPBYTES 8\n", 20), "sound");
  EXPECT_EQ(
      Said("ncols 3\nnrows 2\nxllcorner 1\nyllcorner 2\ncellsize 1\nbyteorder MSBFIRST\n", 24),
      "sound");
}

TEST_F(EsriHeader, RefusesAUnitThatGdalPassesOver) {
  EXPECT_THAT(With("BYTEORDER I\n", "BYTEORDER I\nZUNITS FEET\n", 12), HasSubstr("--height-unit"));
  EXPECT_THAT(With("BYTEORDER I\n", "BYTEORDER I\nZUNITS METERS\n", 12), "sound");
}

TEST_F(EsriHeader, RefusesWhatGdalWouldGuess) {
  EXPECT_THAT(With("BYTEORDER I\n", "", 12), HasSubstr("byteorder LSBFIRST"));
  EXPECT_THAT(With("BYTEORDER I", "BYTEORDER VAX", 12), HasSubstr("\"VAX\""));
  EXPECT_THAT(With("ULXMAP 10\n", "", 12), HasSubstr("no ulxmap"));
  EXPECT_THAT(With("ULXMAP 10", "ULXMAP 420,000.5", 12), HasSubstr("\"420,000.5\" for ulxmap"));
  EXPECT_THAT(Said("ncols 2\nnrows 2\nxllcenter 1\nyllcorner 2\ncellsize 1\nnbits 8\n", 4),
              HasSubstr("corners alone"));
  EXPECT_THAT(With("XDIM 2", "XDIM 0", 12), HasSubstr("larger than 0"));
  EXPECT_THAT(With("BANDROWBYTES 6", "BANDROWBYTES 8", 12), HasSubstr("gaps"));
  EXPECT_THAT(With("NBITS 16", "NBITS 12", 12), HasSubstr("12 bits"));
  EXPECT_THAT(With("NCOLS 3", "NCOLS 2", 12), HasSubstr("6"));
  EXPECT_THAT(With("NROWS 2", "NROWS 1", 12), HasSubstr("disagree"));
  EXPECT_THAT(With("", "", 10), HasSubstr("truncated"));
  EXPECT_THAT(With("NCOLS 3", "NCOLS 999999999", 12), HasSubstr("gaps"));
  EXPECT_THAT(Said("nrows 999999999\nncols 999999999\nnbits 8\nxllcorner 1\nyllcorner 2\n"
                   "cellsize 1\n",
                   12),
              HasSubstr("truncated"));
}

}  // namespace
}  // namespace farhorizon

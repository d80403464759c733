#include "service/cli/tile_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/json_schema.h"
#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

using testing::ElementsAre;

TEST(TileList, HasTheDemsOfAFolderAndAList) {
  const TempDir folder;
  std::filesystem::create_directories(folder / "tiles" / "sub.tif");
  for (const char* name :
       {"b.TIF", "a.asc", "N46E007.hgt.zip", "a.prj", "b.tif.aux.xml", ".c.tif", "README"}) {
    SpillFile(folder / "tiles" / name, "x");
  }
  SpillFile(folder / "list", "# ours\n/far/away.tif\r\n\nc.dat\n");
  const std::string tiles = (folder / "tiles").string();
  const auto read = ReadTileList({tiles, "d.bin"}, (folder / "list").string());
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_THAT(*read, ElementsAre(tiles + "/N46E007.hgt.zip", tiles + "/a.asc", tiles + "/b.TIF",
                                 "d.bin", "/far/away.tif", "c.dat"));
}

TEST(TileList, RefusesWhatWouldGoToOneFolderOrNowhere) {
  const TempDir folder;
  EXPECT_EQ(ReadTileList({}, "").error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(ReadTileList({folder.path().string()}, "").error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(ReadTileList({}, (folder / "none").string()).error().code, ErrorCode::kNotFound);
  const auto twice = ReadTileList({"a/dem.tif", "b/dem.tif"}, "");
  ASSERT_FALSE(twice);
  EXPECT_THAT(twice.error().message, testing::HasSubstr("two of the DEMs are called dem.tif"));
}

}  // namespace
}  // namespace farhorizon

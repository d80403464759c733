#include "service/cli/tile_table.h"

#include <gtest/gtest.h>

#include "tests/support/json_schema.h"
#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

TEST(TileTable, IsReadAsItWasWritten) {
  const TempDir folder;
  TileTable table(folder / "jobs.tsv", {{"a.tif", "", "waiting"}, {"b.tif", "", "waiting"}});
  ASSERT_TRUE(table.Set(0, {"a.tif", "id", "failed", "no-crs", "give it\tor\nnot", "k"}));
  ASSERT_TRUE(table.Set(1, {"b.tif", "id2", "successful", "", "", "l"})) << "not yet in the file";
  ASSERT_TRUE(table.Write());
  EXPECT_EQ(SlurpFile(folder / "jobs.tsv"),
            "dem\tjob\tstatus\tcode\tdetail\tkey\n"
            "a.tif\tid\tfailed\tno-crs\tgive it or not\tk\n"
            "b.tif\tid2\tsuccessful\t\t\tl\n");
  const auto rows = TileTable::Read(folder / "jobs.tsv");
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows.at("a.tif").detail, "give it or not");
  EXPECT_EQ(rows.at("b.tif").job, "id2");
  EXPECT_EQ(rows.at("b.tif").key, "l");
}

TEST(TileTable, TakesNothingFromAnotherFile) {
  const TempDir folder;
  EXPECT_TRUE(TileTable::Read(folder / "none").empty());
  SpillFile(folder / "jobs.tsv", "name\tjob\na.tif\tid\n");
  EXPECT_TRUE(TileTable::Read(folder / "jobs.tsv").empty());
}

}  // namespace
}  // namespace farhorizon

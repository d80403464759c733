#include "core/io/raster/sealed_folder.h"

#include <cpl_vsi.h>
#include <gtest/gtest.h>

#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

bool Opens(const std::string& path, const char* access = "rb") {
  VSILFILE* file = VSIFOpenL(path.c_str(), access);
  if (file != nullptr) VSIFCloseL(file);
  return file != nullptr;
}

TEST(SealedFolder, HasItsMembersAndNoOtherFile) {
  const TempDir dir;
  SpillFile(dir / "dem.img", "0123456789");
  SpillFile(dir / "dem.ige", "secret");
  std::string inside;
  {
    const SealedFolder folder({{"dem.img", dir / "dem.img"}, {"dem.hdr", dir / "dem.ige"}});
    inside = folder.PathOf("dem.img");
    EXPECT_TRUE(Opens(inside));
    EXPECT_TRUE(Opens(folder.PathOf("dem.hdr")));
    VSIStatBufL status;
    ASSERT_EQ(VSIStatL(inside.c_str(), &status), 0);
    EXPECT_EQ(status.st_size, 10);
    EXPECT_FALSE(Opens(folder.PathOf("dem.ige")));
    EXPECT_FALSE(Opens(folder.PathOf("../dem.ige")));
    EXPECT_FALSE(Opens(folder.PathOf((dir / "dem.ige").string())));
    EXPECT_FALSE(Opens(inside, "rb+"));
    EXPECT_FALSE(Opens(inside, "wb"));
    const SealedFolder other({{"a", dir / "dem.ige"}});
    EXPECT_FALSE(Opens(other.PathOf("dem.img")));
  }
  EXPECT_FALSE(Opens(inside));
  EXPECT_EQ(SlurpFile(dir / "dem.img"), "0123456789");
}

TEST(SealedFolder, ReadsFromAnyPlace) {
  const TempDir dir;
  SpillFile(dir / "a", "0123456789");
  const SealedFolder folder({{"a", dir / "a"}});
  VSILFILE* file = VSIFOpenL(folder.PathOf("a").c_str(), "rb");
  ASSERT_NE(file, nullptr);
  ASSERT_EQ(VSIFSeekL(file, 7, SEEK_SET), 0);
  std::string read(5, ' ');
  EXPECT_EQ(VSIFReadL(read.data(), 1, 5, file), 3U);
  EXPECT_EQ(read.substr(0, 3), "789");
  EXPECT_NE(VSIFEofL(file), 0);
  EXPECT_EQ(VSIFTellL(file), 10U);
  VSIFCloseL(file);
}

}  // namespace
}  // namespace farhorizon

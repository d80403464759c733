#include "service/worker/folder_bytes.h"

#include <fstream>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

constexpr std::int64_t kAll = std::numeric_limits<std::int64_t>::max();

TEST(FolderBytes, AddsUpWhatTakesRoomInAllFolders) {
  const TempDir folder;
  EXPECT_EQ(BytesIn(folder.path(), kAll), 0);
  std::filesystem::create_directories(folder / "a/b");
  std::ofstream(folder / "a/b/large") << std::string(1 << 20, 'x') << std::flush;
  std::ofstream(folder / "sparse").seekp(1 << 30).put('x');
  EXPECT_GE(BytesIn(folder.path(), kAll), 1 << 20);
  EXPECT_LT(BytesIn(folder.path(), kAll), 1 << 22) << "holes take no room";
}

TEST(FolderBytes, CountsSmallFilesAndFollowsNoLink) {
  const TempDir folder;
  const TempDir elsewhere;
  std::ofstream(elsewhere / "large") << std::string(1 << 20, 'x');
  std::filesystem::create_directory_symlink(elsewhere.path(), folder / "link");
  for (int i = 0; i < 9; ++i) std::ofstream(folder / std::to_string(i));
  EXPECT_EQ(BytesIn(folder.path(), kAll), 10 << 16);
  EXPECT_EQ(BytesIn(folder.path(), 1 << 17), 3 << 16) << "no further than needed";
}

TEST(FolderBytes, AFolderThatIsNotThereHasNothing) { EXPECT_EQ(BytesIn("/nowhere/at/all", 1), 0); }

}  // namespace
}  // namespace farhorizon

#include "core/io/file.h"

#include <sys/stat.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/sha256.h"
#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

TEST(AbsolutePath, IsFromTheRootWhereThereIsAWay) {
  EXPECT_EQ(AbsolutePath("/a/./b/../c/"), "/a/c");
  EXPECT_EQ(AbsolutePath("/"), "/");
  EXPECT_EQ(AbsolutePath("a"), std::filesystem::current_path() / "a");
  EXPECT_EQ(AbsolutePath(""), "");
}

TEST(Sha256OfFile, IsThatOfItsBytesHoweverMany) {
  const TempDir dir;
  const std::string bytes(1'000'000, 'a');
  SpillFile(dir / "a", bytes);
  Result<std::string> sum = Sha256OfFile(dir / "a");
  ASSERT_TRUE(sum);
  EXPECT_EQ(*sum, "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
  EXPECT_EQ(*sum, Sha256Hex(bytes));
  EXPECT_EQ(Sha256OfFile(dir / "b").error().code, ErrorCode::kNotFound);
}

TEST(ReadFile, GivesBackWhatWasWritten) {
  const TempDir dir;
  const std::string bytes("a\0b\n", 4);
  ASSERT_TRUE(WriteFile(dir / "a", bytes));
  Result<std::string> back = ReadFile(dir / "a");
  ASSERT_TRUE(back);
  EXPECT_EQ(*back, bytes);
}

TEST(ReadFile, RefusesMoreThanItMayTake) {
  const TempDir dir;
  SpillFile(dir / "a", "12345");
  EXPECT_TRUE(ReadFile(dir / "a", 5));
  EXPECT_EQ(ReadFile(dir / "a", 4).error().code, ErrorCode::kResourceExhausted);
}

TEST(ReadFile, RefusesFoldersAndNamesNoFolderInItsMessage) {
  const TempDir dir;
  Result<std::string> read = ReadFile(dir.path());
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, ErrorCode::kIo);
  read = ReadFile(dir / "missing");
  ASSERT_FALSE(read);
  EXPECT_THAT(read.error().message, ::testing::Not(::testing::HasSubstr(dir.path().string())));
}

TEST(WriteFile, ReplacesWhatWasThereAndLeavesNothingBeside) {
  const TempDir dir;
  ASSERT_TRUE(WriteFile(dir / "a", "old"));
  ASSERT_TRUE(WriteFile(dir / "a", "new"));
  EXPECT_EQ(SlurpFile(dir / "a"), "new");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(dir.path()), {}), 1);
}

TEST(WriteFile, FailsWhereTheFolderIsMissing) {
  const TempDir dir;
  Status written = WriteFile(dir / "no/such/file", "x");
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, ErrorCode::kNotFound);
}

TEST(WriteFile, LeavesTheOldFileWhereTheTargetCannotBeReplaced) {
  const TempDir dir;
  std::filesystem::create_directory(dir / "a");
  EXPECT_FALSE(WriteFile(dir / "a", "x"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(dir.path()), {}), 1);
}

}  // namespace
}  // namespace farhorizon

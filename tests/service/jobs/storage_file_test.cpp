#include "service/jobs/storage_file.h"

#include <cerrno>
#include <sys/stat.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/posix_file.h"
#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

TEST(StorageError, HasTheKindThatClientsSwitchOn) {
  errno = ENOSPC;
  const Error full = StorageError("write");
  EXPECT_EQ(full.code, ErrorCode::kResourceExhausted);
  EXPECT_EQ(full.kind, "no-space");
  errno = EACCES;
  const Error denied = StorageError("open a file");
  EXPECT_EQ(denied.code, ErrorCode::kIo);
  EXPECT_EQ(denied.kind, "storage");
  EXPECT_THAT(denied.message, testing::StartsWith("open a file: "));
}

TEST(OpenForReading, OpensAFile) {
  const TempDir folder;
  SpillFile(folder / "a", "hello");
  auto file = OpenForReading(folder / "a");
  ASSERT_TRUE(file);
  std::string bytes(5, ' ');
  EXPECT_EQ(ReadSome(file->get(), bytes), 5);
  EXPECT_EQ(bytes, "hello");
}

TEST(OpenForReading, RefusesWhatIsNoRegularFile) {
  const TempDir folder;
  SpillFile(folder / "a", "hello");
  std::filesystem::create_symlink(folder / "a", folder / "link");
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_EQ(OpenForReading(folder / "link").error().code, ErrorCode::kIo);
  EXPECT_EQ(OpenForReading(folder / "pipe").error().code, ErrorCode::kIo);
  EXPECT_EQ(OpenForReading(folder.path()).error().code, ErrorCode::kIo);
  EXPECT_EQ(OpenForReading(folder / "missing").error().code, ErrorCode::kNotFound);
}

TEST(FreeBytes, AreKnownOfAFolderThatExists) {
  const TempDir folder;
  auto bytes = FreeBytes(folder.path());
  ASSERT_TRUE(bytes);
  EXPECT_GT(*bytes, 0);
  EXPECT_EQ(FreeBytes(folder / "missing").error().kind, "storage");
}

}  // namespace
}  // namespace farhorizon

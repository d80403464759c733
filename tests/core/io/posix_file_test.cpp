#include "core/io/posix_file.h"

#include <array>
#include <cerrno>
#include <fcntl.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/unique_fd.h"
#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

TEST(ErrorFromErrno, TellsFullStorageFromOtherFailures) {
  for (const int number : {ENOSPC, EDQUOT, EFBIG}) {
    EXPECT_EQ(ErrorFromErrno("write", number).code, ErrorCode::kResourceExhausted) << number;
  }
  const Error error = ErrorFromErrno("open a file", EACCES);
  EXPECT_EQ(error.code, ErrorCode::kIo);
  EXPECT_THAT(error.message, testing::StartsWith("open a file: "));
}

TEST(WriteAll, WritesEveryByteOrFails) {
  const TempDir dir;
  const std::string bytes(300'000, 'a');
  const UniqueFd file(::open((dir / "a").c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600));
  EXPECT_TRUE(WriteAll(file.get(), bytes));
  EXPECT_EQ(SlurpFile(dir / "a"), bytes);
  const UniqueFd read_only(::open((dir / "a").c_str(), O_RDONLY | O_CLOEXEC));
  EXPECT_FALSE(WriteAll(read_only.get(), "b"));
  EXPECT_EQ(errno, EBADF);
}

TEST(ReadSome, ReadsUpToTheEnd) {
  const TempDir dir;
  SpillFile(dir / "a", "12345");
  const UniqueFd file(::open((dir / "a").c_str(), O_RDONLY | O_CLOEXEC));
  std::array<char, 4> bytes{};
  EXPECT_EQ(ReadSome(file.get(), bytes), 4);
  EXPECT_EQ(ReadSome(file.get(), bytes), 1);
  EXPECT_EQ(bytes[0], '5');
  EXPECT_EQ(ReadSome(file.get(), bytes), 0);
  EXPECT_EQ(ReadSome(-1, bytes), -1);
}

TEST(SyncDirectory, TellsAMissingFolderByErrno) {
  const TempDir dir;
  EXPECT_TRUE(SyncDirectory(dir.path()));
  EXPECT_FALSE(SyncDirectory(dir / "missing"));
  EXPECT_EQ(errno, ENOENT);
}

}  // namespace
}  // namespace farhorizon

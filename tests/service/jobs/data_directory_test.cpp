#include "service/jobs/data_directory.h"

#include <functional>
#include <signal.h>
#include <string>
#include <sys/stat.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "service/jobs/end_mark.h"
#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

using testing::AllOf;
using testing::HasSubstr;

mode_t ModeOf(const std::filesystem::path& path) {
  struct stat info {};
  EXPECT_EQ(::stat(path.c_str(), &info), 0) << path;
  return info.st_mode & 07777;
}

class DataDirectoryTest : public testing::Test {
 protected:
  std::string Refusal() {
    const auto opened = OpenDataDirectory(data_);
    return opened ? "" : opened.error().message;
  }
  TempDir folder_;
  const std::filesystem::path data_ = folder_ / "data";
};

TEST_F(DataDirectoryTest, IsForItsOwnerAlone) {
  const auto opened = OpenDataDirectory(data_);
  ASSERT_TRUE(opened) << opened.error().message;
  EXPECT_EQ(ModeOf(data_), 0700U);
  EXPECT_EQ(ModeOf(data_ / "lock"), 0600U);
  EXPECT_EQ(ModeOf(data_ / "spool"), 0700U);
  EXPECT_EQ(ModeOf(data_ / "work"), 0700U);
}

TEST_F(DataDirectoryTest, TakesAnEarlierVersionsFilesFromOthersEyes) {
  std::filesystem::create_directories(data_ / "objects" / "ab");
  SpillFile(data_ / "jobs.sqlite", "");
  for (const char* name : {"", "objects", "objects/ab"}) ::chmod((data_ / name).c_str(), 0755);
  ::chmod((data_ / "jobs.sqlite").c_str(), 0644);
  ASSERT_EQ(Refusal(), "");
  EXPECT_EQ(ModeOf(data_), 0700U);
  EXPECT_EQ(ModeOf(data_ / "objects"), 0700U);
  EXPECT_EQ(ModeOf(data_ / "objects" / "ab"), 0700U);
  EXPECT_EQ(ModeOf(data_ / "jobs.sqlite"), 0600U);
}

TEST_F(DataDirectoryTest, RefusesWhatOthersCanWriteAndSaysTheRemedy) {
  std::filesystem::create_directories(data_ / "objects");
  SpillFile(data_ / "jobs.sqlite", "");
  for (const char* name : {"", "objects", "jobs.sqlite"}) {
    const std::filesystem::path path = data_ / name;
    const mode_t mode = ModeOf(path);
    ::chmod(path.c_str(), mode | 0020);
    EXPECT_THAT(Refusal(), AllOf(HasSubstr("written by other users"),
                                 HasSubstr("chmod -R go-rwx " + data_.string())))
        << name;
    ::chmod(path.c_str(), mode);
  }
  EXPECT_EQ(Refusal(), "");
}

TEST_F(DataDirectoryTest, RefusesALinkInIt) {
  std::filesystem::create_directories(data_ / "objects");
  std::filesystem::create_directories(folder_ / "elsewhere");
  for (const char* name : {"spool", "jobs.sqlite", "objects/ab", "lock"}) {
    std::filesystem::create_symlink(folder_ / "elsewhere", data_ / name);
    EXPECT_THAT(Refusal(), HasSubstr(std::string(name) + " is a link")) << name;
    std::filesystem::remove(data_ / name);
  }
  EXPECT_EQ(Refusal(), "");
}

TEST_F(DataDirectoryTest, IsForOneProcessEvenWithoutItsLockFile) {
  const auto first = OpenDataDirectory(data_);
  ASSERT_TRUE(first);
  EXPECT_TRUE(first->CheckHeld());
  EXPECT_THAT(Refusal(), HasSubstr("in use by another farhorizon"));
  std::filesystem::remove(data_ / "lock");
  EXPECT_THAT(Refusal(), HasSubstr("in use by another farhorizon"));
  EXPECT_THAT(first->CheckHeld().error().message, HasSubstr("removed or replaced"));
}

TEST_F(DataDirectoryTest, NoticesThatItWasReplaced) {
  const auto first = OpenDataDirectory(data_);
  ASSERT_TRUE(first);
  std::filesystem::rename(data_, folder_ / "away");
  EXPECT_FALSE(first->CheckHeld());
  std::filesystem::create_directories(data_);
  EXPECT_FALSE(first->CheckHeld());
}

TEST_F(DataDirectoryTest, KnowsHowTheProcessBeforeEnded) {
  const auto end = [&](const std::function<void(int)>& mark) {
    {
      const auto opened = OpenDataDirectory(data_);
      EXPECT_TRUE(opened);
      mark(opened->lock.get());
    }
    return OpenDataDirectory(data_)->previous_end;
  };
  EXPECT_EQ(end([](int) {}), PreviousEnd::kKilled) << "an earlier version says nothing";
  EXPECT_EQ(end(MarkRunning), PreviousEnd::kKilled);
  EXPECT_EQ(end([](int lock) {
              MarkRunning(lock);
              MarkOrderly(lock);
            }),
            PreviousEnd::kOrderly);
  EXPECT_EQ(end(MarkRunning), PreviousEnd::kKilled) << "the mark before was longer";
}

TEST_F(DataDirectoryTest, ASignalOfItsOwnIsACrash) {
#if defined(__SANITIZE_ADDRESS__)
  const testing::ExitedWithCode dies(1);  // the earlier handler is the sanitizer's
#else
  const testing::KilledBySignal dies(SIGBUS);
#endif
  { ASSERT_TRUE(OpenDataDirectory(data_)); }
  EXPECT_EXIT(
      {
        const auto opened = OpenDataDirectory(data_);
        MarkRunning(opened->lock.get());
        MarkFatalSignals(opened->lock.get());
        ::raise(SIGBUS);
      },
      dies, "");
  EXPECT_EQ(OpenDataDirectory(data_)->previous_end, PreviousEnd::kCrashed);
}

}  // namespace
}  // namespace farhorizon

#include "service/jobs/storage_health.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "service/jobs/sqlite_job_store.h"
#include "service/jobs/sync_failure.h"
#include "tests/service/simulation/memory_objects.h"
#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

class StorageHealthTest : public testing::Test {
 protected:
  void SetUp() override {
    auto directory = OpenDataDirectory(folder_ / "data");
    ASSERT_TRUE(directory);
    directory_ = std::make_unique<DataDirectory>(*std::move(directory));
    auto jobs = OpenSqliteJobStore(directory_->Jobs());
    ASSERT_TRUE(jobs);
    jobs_ = *std::move(jobs);
  }
  TempDir folder_;
  std::unique_ptr<DataDirectory> directory_;
  std::unique_ptr<JobStore> jobs_;
  MemoryObjects objects_;
};

TEST_F(StorageHealthTest, WritesAndLeavesNothing) {
  StorageHealth health(*directory_, *jobs_, objects_, 0);
  EXPECT_TRUE(health.CheckRoom());
  EXPECT_TRUE(health.CheckWrites());
  EXPECT_FALSE(std::filesystem::exists(folder_ / "data" / "probe"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "data" / "probed"));
}

TEST_F(StorageHealthTest, SaysThatThereIsNoRoom) {
  const StorageHealth health(*directory_, *jobs_, objects_,
                             std::numeric_limits<std::int64_t>::max());
  EXPECT_EQ(health.CheckRoom().error().kind, "no-space");
}

TEST_F(StorageHealthTest, SaysThatTheLockWent) {
  const StorageHealth health(*directory_, *jobs_, objects_, 0);
  std::filesystem::remove(folder_ / "data" / "lock");
  EXPECT_EQ(health.CheckRoom().error().kind, "data-directory");
}

TEST_F(StorageHealthTest, SaysThatAFileCannotBeMade) {
  StorageHealth health(*directory_, *jobs_, objects_, 0);
  std::filesystem::create_directory(folder_ / "data" / "probe");  // stands in its way
  EXPECT_EQ(health.CheckWrites().error().kind, "storage");
}

TEST(DiskReserve, IsGivenBackOnceAndMadeAgain) {
  const TempDir folder;
  DiskReserve reserve(folder / "reserve");
  EXPECT_FALSE(reserve.Release());
  for (int i = 0; i < 2; ++i) {
    reserve.Ensure();
    EXPECT_GE(std::filesystem::file_size(folder / "reserve"), 1U << 20U);
    EXPECT_TRUE(reserve.Release());
    EXPECT_FALSE(reserve.Release());
  }
}

TEST(EndAfterFailedSync, EndsWithAStatusOfItsOwn) {
  EXPECT_EXIT(
      {
        BeforeSyncEnd([] { std::fputs("last call\n", stderr); });
        EndAfterFailedSync("sync an object: Input/output error");
      },
      testing::ExitedWithCode(74), "last call\n.*sync an object: Input/output error");
}

}  // namespace
}  // namespace farhorizon

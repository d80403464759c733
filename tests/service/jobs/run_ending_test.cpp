#include "service/jobs/run_ending.h"

#include <gtest/gtest.h>

#include "service/jobs/sqlite_job_store.h"
#include "tests/service/simulation/memory_objects.h"
#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

class RunEndingTest : public testing::Test {
 protected:
  void SetUp() override {
    auto directory = OpenDataDirectory(folder_ / "data");
    ASSERT_TRUE(directory);
    directory_ = std::make_unique<DataDirectory>(*std::move(directory));
    auto jobs = OpenSqliteJobStore(directory_->Jobs());
    ASSERT_TRUE(jobs);
    jobs_ = *std::move(jobs);
    health_ = std::make_unique<StorageHealth>(*directory_, *jobs_, objects_, 0);
    ending_ = std::make_unique<RunEnding>(*jobs_, *health_);
    ASSERT_TRUE(jobs_->Insert({"a", {}, std::string(64, 'a'), 5, {}}, {}, 1));
  }
  Job Claim() {
    // Later than any delay.
    auto claimed = jobs_->ClaimNext(time_ += std::int64_t{40'000'000'000'000}, {});
    EXPECT_TRUE(claimed && *claimed);
    return claimed && *claimed ? **claimed : Job{};
  }
  Job Stored() { return jobs_->List({{}, {}, 1})->jobs.at(0); }

  TempDir folder_;
  std::unique_ptr<DataDirectory> directory_;
  std::unique_ptr<JobStore> jobs_;
  MemoryObjects objects_;
  std::unique_ptr<StorageHealth> health_;
  std::unique_ptr<RunEnding> ending_;
  std::int64_t time_ = 0;
};

const Error kFull = {ErrorCode::kResourceExhausted, "write: no space", "no-space"};

TEST_F(RunEndingTest, AFaultOfTheMachineNeverFailsAJob) {
  for (const Error& fault :
       {kFull, Error{ErrorCode::kIo, "sync", "storage"}, Error{ErrorCode::kIo, "x", "job-store"},
        Error{ErrorCode::kResourceExhausted, "the service is out of memory"}}) {
    for (int i = 0; i < 5; ++i) ending_->Failed(Claim(), fault, {});
  }
  const Error no_process = {ErrorCode::kResourceExhausted, "fork", "worker-not-started"};
  for (int i = 0; i < 5; ++i) ending_->WorkerCrashed(Claim(), no_process, {});
  EXPECT_EQ(Stored().state, JobState::kAccepted);
  EXPECT_EQ(Stored().attempt, 0);
  EXPECT_EQ(Stored().crash_count, 0);
  EXPECT_EQ(Stored().retries, 25);
}

TEST_F(RunEndingTest, AFaultOfTheDataFailsItAtOnce) {
  ending_->WorkerFailed(Claim(), {ErrorCode::kUnsupportedData, "no system", "no-crs"}, {});
  EXPECT_EQ(Stored().state, JobState::kFailed);
  EXPECT_EQ(Stored().failure->kind, "no-crs");
}

TEST_F(RunEndingTest, ADamagedRowIsNoFaultOfTheMachines) {
  ending_->DataFailed(Claim(), {ErrorCode::kIo, "the job's row is damaged", "job-store"}, {});
  EXPECT_EQ(Stored().state, JobState::kFailed);
}

TEST_F(RunEndingTest, AWorkerIsBelievedForAWhile) {
  int runs = 0;
  while (Stored().state == JobState::kAccepted && ++runs < 100) {
    ending_->WorkerFailed(Claim(), kFull, {});
  }
  EXPECT_EQ(runs, 9);
  EXPECT_EQ(Stored().failure->kind, "no-space");
}

TEST_F(RunEndingTest, ACrashIsForgivenOnce) {
  const Error stuck = {ErrorCode::kIo, "it stood still", "worker-stuck"};
  ending_->WorkerCrashed(Claim(), stuck, {});
  EXPECT_EQ(Stored().state, JobState::kAccepted);
  ending_->WorkerCrashed(Claim(), stuck, {});
  EXPECT_EQ(Stored().state, JobState::kFailed);
  EXPECT_EQ(Stored().failure->kind, "worker-stuck");
  EXPECT_EQ(Stored().attempt, 2);
}

TEST_F(RunEndingTest, ACrashOnADiskThatFailsIsTheMachines) {
  std::filesystem::create_directory(folder_ / "data" / "probe");
  for (int i = 0; i < 3; ++i) {
    ending_->WorkerCrashed(Claim(), {ErrorCode::kIo, "it died", "worker-crashed"}, {});
  }
  EXPECT_EQ(Stored().state, JobState::kAccepted);
}

}  // namespace
}  // namespace farhorizon

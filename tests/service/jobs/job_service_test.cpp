// What a start does with the data directory that it finds.
#include "service/jobs/job_service.h"

#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "service/jobs/sqlite.h"
#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class JobServiceTest : public testing::Test {
 protected:
  Result<std::unique_ptr<JobService>> Open(const fs::path& data) const {
    JobServiceOptions options;
    options.data = data;
    options.workers = 0;  // nothing runs
    options.min_free_bytes = 0;
    options.retention = retention_;
    return JobService::Open(options);
  }
  /// The folder of a service that was stopped, with some jobs that wait.
  fs::path Filled(const std::string& name, int jobs = 3) {
    auto service = Open(folder_ / name);
    EXPECT_TRUE(service) << service.error().message;
    for (int i = 0; i < jobs; ++i) Submit(**service, name + std::to_string(i));
    (*service)->Stop();
    return folder_ / name;
  }
  static std::string Submit(JobService& service, const std::string& content) {
    auto spool = service.NewSpoolFile();
    EXPECT_TRUE(spool && spool->Write(content));
    auto job = service.Submit(*spool, {"a.tif", {}, {}, {}, "192.0.2.1"});
    EXPECT_TRUE(job) << job.error().message;
    return job->id;
  }
  std::string Refusal(const fs::path& data) const {
    const auto opened = Open(data);
    return opened ? "" : opened.error().message;
  }
  /// All files of objects, wherever they are.
  static std::size_t Objects(const fs::path& data) {
    std::size_t count = 0;
    for (const auto& entry : fs::recursive_directory_iterator(data / "objects")) {
      count += IsSha256(entry.path().filename().string()) ? 1 : 0;
    }
    return count;
  }
  static std::size_t Jobs(JobService& service) { return service.List({{}, {}, 100})->jobs.size(); }

  TempDir folder_;
  Retention retention_;
};

TEST_F(JobServiceTest, StartsAgainWithAllThatItHad) {
  const fs::path data = Filled("d");
  auto again = Open(data);
  ASSERT_TRUE(again);
  EXPECT_EQ(Jobs(**again), 3U);
  EXPECT_EQ(Objects(data), 3U);
}

TEST_F(JobServiceTest, RefusesWithoutItsDatabaseAndDeletesNothing) {
  const fs::path data = Filled("d");
  fs::rename(data / "jobs.sqlite", folder_ / "kept");
  for (const bool empty : {false, true}) {
    if (empty) SpillFile(data / "jobs.sqlite", "");
    EXPECT_THAT(Refusal(data), testing::AllOf(HasSubstr("is missing or empty"),
                                              HasSubstr("put the database back")));
    EXPECT_EQ(Objects(data), 3U);
    EXPECT_EQ(fs::exists(data / "jobs.sqlite"), empty);
  }
  fs::rename(folder_ / "kept", data / "jobs.sqlite");
  EXPECT_EQ(Refusal(data), "");
}

TEST_F(JobServiceTest, RefusesADatabaseOfAnEarlierVersionsObjectsToo) {
  const fs::path data = Filled("d");
  fs::remove(data / "objects" / "identity");  // earlier versions wrote none
  fs::remove(data / "jobs.sqlite");
  EXPECT_THAT(Refusal(data), HasSubstr("is missing or empty"));
  EXPECT_EQ(Objects(data), 3U);
}

TEST_F(JobServiceTest, RefusesTheObjectsOfAnotherDatabase) {
  const fs::path one = Filled("one");
  const fs::path two = Filled("two");
  fs::copy_file(one / "jobs.sqlite", two / "jobs.sqlite", fs::copy_options::overwrite_existing);
  EXPECT_THAT(Refusal(two),
              testing::AllOf(HasSubstr("belong to another database"), HasSubstr("fsck")));
  EXPECT_EQ(Objects(two), 3U);
}

TEST_F(JobServiceTest, RefusesADatabaseThatIsOlderThanItsObjects) {
  const fs::path data = Filled("d");
  fs::copy_file(data / "jobs.sqlite", folder_ / "backup");
  { ASSERT_TRUE(Open(data)); }
  fs::copy_file(folder_ / "backup", data / "jobs.sqlite", fs::copy_options::overwrite_existing);
  EXPECT_THAT(Refusal(data), HasSubstr("is older than the uploads and results"));
  EXPECT_EQ(Objects(data), 3U);
}

TEST_F(JobServiceTest, RefusesWhereTheObjectsOfItsJobsAreGone) {
  const fs::path data = Filled("d");
  fs::rename(data / "objects", folder_ / "unmounted");
  EXPECT_THAT(Refusal(data), HasSubstr("are gone"));
  fs::remove_all(data / "objects");
  fs::rename(folder_ / "unmounted", data / "objects");
  EXPECT_EQ(Refusal(data), "");
}

TEST_F(JobServiceTest, SetsAsideTheObjectsOfJobsThatTheDatabaseHasLost) {
  const fs::path data = Filled("d");
  {
    Database database;
    database.Open(data / "jobs.sqlite");
    database.Execute("DELETE FROM jobs WHERE id IN (SELECT id FROM jobs LIMIT 2)");
  }
  auto opened = Open(data);
  ASSERT_TRUE(opened) << opened.error().message;
  EXPECT_EQ(Jobs(**opened), 1U);
  EXPECT_EQ(Objects(data), 3U);
  EXPECT_EQ(std::distance(fs::directory_iterator(data / "objects" / "stray"), {}), 2);
}

TEST_F(JobServiceTest, LeavesAloneWhatIsNoObject) {
  const fs::path data = Filled("d");
  SpillFile(data / "objects" / "notes.txt", "mine");
  SpillFile(data / "README", "mine");
  EXPECT_EQ(Refusal(data), "");
  EXPECT_EQ(SlurpFile(data / "objects" / "notes.txt"), "mine");
  EXPECT_EQ(SlurpFile(data / "README"), "mine");
}

TEST_F(JobServiceTest, ExpiresWhatHasEndedAndSaysWhen) {
  retention_ = {3600, 0, 0};
  auto service = Open(folder_ / "d");
  ASSERT_TRUE(service);
  const std::string id = Submit(**service, "x");
  EXPECT_FALSE((*service)->Find(id)->expires_ms);
  const auto ended = (*service)->Dismiss(id);
  ASSERT_TRUE(ended);
  EXPECT_EQ(ended->expires_ms, *ended->finished_ms + 3'600'000);
  EXPECT_EQ((*service)->Find(id)->expires_ms, ended->expires_ms);
}

TEST_F(JobServiceTest, RemovesExpiredJobsWithTheirObjects) {
  retention_ = {0, 1, 0};
  auto service = Open(folder_ / "d");
  ASSERT_TRUE(service);
  for (const char* content : {"a", "b", "c"}) {
    ASSERT_TRUE((*service)->Dismiss(Submit(**service, content)));
  }
  for (int tries = 0; tries < 200 && (Jobs(**service) > 1 || Objects(folder_ / "d") > 1); ++tries) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  EXPECT_EQ(Jobs(**service), 1U);
  EXPECT_EQ(Objects(folder_ / "d"), 1U);
}

TEST_F(JobServiceTest, StopsTakingJobsWhenItsLockWent) {
  auto service = Open(folder_ / "d");
  ASSERT_TRUE(service);
  const auto room = [&] { return (*service)->CheckReady().at(1).status; };
  EXPECT_TRUE(room());
  fs::remove(folder_ / "d" / "lock");
  EXPECT_EQ(room().error().kind, "data-directory");
  EXPECT_EQ((*service)->CheckRoom("a").error().kind, "data-directory");
}

}  // namespace
}  // namespace farhorizon

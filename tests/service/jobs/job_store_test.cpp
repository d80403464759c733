// The properties of every JobStore. A new implementation adds a line to INSTANTIATE_TEST_SUITE_P.
#include <atomic>
#include <functional>
#include <memory>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "service/jobs/sqlite.h"
#include "service/jobs/sqlite_job_store.h"
#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

using OpenJobs = std::function<Result<std::unique_ptr<JobStore>>(const std::filesystem::path&)>;

class JobStoreConformance : public testing::TestWithParam<OpenJobs> {
 protected:
  void SetUp() override { Reopen(); }
  void Reopen() {
    store_.reset();
    auto opened = GetParam()(folder_.path());
    ASSERT_TRUE(opened) << opened.error().message;
    store_ = *std::move(opened);
  }
  Job Insert(const std::string& content = "a", std::optional<std::string> key = {}) {
    NewJob job{NewJobId(++time_),           "dem.tif", {{"levels", "2"}},
               std::string(64, content[0]), 5,         std::move(key)};
    auto inserted = store_->Insert(job, time_);
    EXPECT_TRUE(inserted);
    return *inserted;
  }
  Job Claim() {
    auto claimed = store_->ClaimNext(++time_);
    EXPECT_TRUE(claimed && *claimed);
    return **claimed;
  }
  JobState StateOf(const Job& job) { return store_->Find(job.id)->state; }

  TempDir folder_;
  std::unique_ptr<JobStore> store_;
  std::int64_t time_ = 1'700'000'000'000;
};

TEST_P(JobStoreConformance, KeepsAJobOverAReopen) {
  const Job job = Insert();
  Reopen();
  const auto found = store_->Find(job.id);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->state, JobState::kAccepted);
  EXPECT_EQ(found->parameters, job.parameters);
  EXPECT_EQ(found->filename, "dem.tif");
  EXPECT_EQ(found->input_bytes, 5);
}

TEST_P(JobStoreConformance, HandsOutEachJobOnceOldestFirst) {
  const Job first = Insert();
  const Job second = Insert();
  EXPECT_EQ(Claim().id, first.id);
  EXPECT_EQ(Claim().id, second.id);
  const auto none = store_->ClaimNext(++time_);
  ASSERT_TRUE(none);
  EXPECT_FALSE(*none);
}

TEST_P(JobStoreConformance, HandsOutEachJobOnceToManyThreads) {
  constexpr int kJobs = 60;
  for (int i = 0; i < kJobs; ++i) Insert();
  std::atomic<int> claimed{0};
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&] {
      for (;;) {
        auto job = store_->ClaimNext(time_);
        if (!job || !*job) return;
        ++claimed;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(claimed, kJobs);
}

TEST_P(JobStoreConformance, PublishesArtifactsWithTheState) {
  Insert();
  const Job job = Claim();
  EXPECT_TRUE(store_->Artifacts(job.id)->empty());
  const std::vector<Artifact> artifacts = {{"b", "x/y", 1, std::string(64, 'b')},
                                           {"a", "x/z", 2, std::string(64, 'c')}};
  ASSERT_TRUE(*store_->Publish(job.id, job.attempt, artifacts, {{"sweep", 1.5}}, ++time_));
  const auto found = store_->Find(job.id);
  EXPECT_EQ(found->state, JobState::kSuccessful);
  EXPECT_EQ(found->progress, 100);
  EXPECT_EQ(found->finished_ms, time_);
  EXPECT_EQ(found->timings.at("sweep"), 1.5);
  const auto stored = store_->Artifacts(job.id);
  ASSERT_EQ(stored->size(), 2U);
  EXPECT_EQ(stored->at(0).name, "a");
  EXPECT_EQ(stored->at(1).sha256, std::string(64, 'b'));
}

TEST_P(JobStoreConformance, KeepsTheFailure) {
  Insert();
  const Job job = Claim();
  ASSERT_TRUE(*store_->Fail(job.id, job.attempt,
                            {ErrorCode::kUnsupportedData, "no reference system", "no-crs"},
                            ++time_));
  const auto found = store_->Find(job.id);
  ASSERT_TRUE(found->failure);
  EXPECT_EQ(found->failure->code, ErrorCode::kUnsupportedData);
  EXPECT_EQ(found->failure->kind, "no-crs");
  EXPECT_EQ(found->failure->message, "no reference system");
}

std::vector<std::string> CodesOf(const Job& job) {
  std::vector<std::string> codes;
  for (const Assumption& assumption : job.assumptions) codes.push_back(assumption.code);
  return codes;
}

TEST_P(JobStoreConformance, KeepsTheAssumptionsOfTheLastRunThatHasSome) {
  using Codes = std::vector<std::string>;
  const NewJob probed{NewJobId(++time_), "dem.tif", {}, std::string(64, 'a'), 5, {},
                      {{"a", "\"é\""}}};
  ASSERT_TRUE(store_->Insert(probed, time_));
  const Job first = Claim();
  EXPECT_EQ(CodesOf(first), Codes{"a"});
  EXPECT_EQ(first.assumptions.at(0).text, "\"é\"");
  const Assumptions two = {{"a", "x"}, {"b", "y"}};
  ASSERT_TRUE(*store_->ReportAssumptions(first.id, first.attempt, two, ++time_));
  ASSERT_TRUE(*store_->Requeue(first.id, first.attempt, RequeueReason::kWorkerCrashed, ++time_));
  EXPECT_EQ(CodesOf(*store_->Find(first.id)), (Codes{"a", "b"}));
  const Job second = Claim();
  ASSERT_TRUE(*store_->ReportAssumptions(second.id, second.attempt, {{"c", "z"}}, ++time_));
  ASSERT_TRUE(*store_->Publish(second.id, second.attempt, {}, {}, ++time_));
  Reopen();
  EXPECT_EQ(CodesOf(*store_->Find(second.id)), Codes{"c"});
}

TEST_P(JobStoreConformance, IgnoresAnEarlierAttempt) {
  Insert();
  const Job earlier = Claim();
  ASSERT_TRUE(
      *store_->Requeue(earlier.id, earlier.attempt, RequeueReason::kWorkerCrashed, ++time_));
  const Job later = Claim();
  EXPECT_EQ(later.id, earlier.id);
  EXPECT_EQ(later.attempt, earlier.attempt + 1);
  EXPECT_EQ(later.crash_count, 1);
  EXPECT_FALSE(*store_->ReportProgress(earlier.id, earlier.attempt, 50, "late", ++time_));
  EXPECT_FALSE(*store_->ReportAssumptions(earlier.id, earlier.attempt, {{"a", "b"}}, ++time_));
  EXPECT_FALSE(*store_->Publish(earlier.id, earlier.attempt, {}, {}, ++time_));
  EXPECT_FALSE(*store_->Fail(earlier.id, earlier.attempt, {ErrorCode::kIo, "x"}, ++time_));
  EXPECT_FALSE(
      *store_->Requeue(earlier.id, earlier.attempt, RequeueReason::kServiceStopped, ++time_));
  EXPECT_TRUE(*store_->Publish(later.id, later.attempt, {}, {}, ++time_));
}

TEST_P(JobStoreConformance, ADismissedJobNeverBecomesSuccessful) {
  Insert();
  const Job job = Claim();
  EXPECT_EQ(store_->Dismiss(job.id, ++time_)->state, JobState::kDismissed);
  EXPECT_FALSE(*store_->Publish(job.id, job.attempt, {}, {}, ++time_));
  EXPECT_FALSE(*store_->Requeue(job.id, job.attempt, RequeueReason::kServiceStopped, ++time_));
  EXPECT_EQ(StateOf(job), JobState::kDismissed);
}

TEST_P(JobStoreConformance, DismissalAndPublicationHaveOneWinner) {
  for (int round = 0; round < 50; ++round) {
    Insert();
    const Job job = Claim();
    bool published = false;
    std::thread publisher(
        [&] { published = *store_->Publish(job.id, job.attempt, {}, {}, time_); });
    ASSERT_TRUE(store_->Dismiss(job.id, time_));
    publisher.join();
    const auto found = store_->Find(job.id);
    // If publication was first, the dismissal removed the job; if not, the job stays dismissed.
    EXPECT_EQ(found.has_value(), !published);
    if (found) {
      EXPECT_EQ(found->state, JobState::kDismissed);
    }
  }
}

TEST_P(JobStoreConformance, RemovesAFinishedJob) {
  Insert();
  const Job job = Claim();
  const std::string object(64, 'b');
  ASSERT_TRUE(*store_->Publish(job.id, job.attempt, {{"a", "x/y", 1, object}}, {}, ++time_));
  EXPECT_TRUE(*store_->IsReferenced(object));
  EXPECT_EQ(store_->Dismiss(job.id, ++time_)->state, JobState::kDismissed);
  EXPECT_EQ(store_->Find(job.id).error().code, ErrorCode::kNotFound);
  EXPECT_EQ(store_->Dismiss(job.id, ++time_).error().code, ErrorCode::kNotFound);
  EXPECT_FALSE(*store_->IsReferenced(object));
  EXPECT_FALSE(*store_->IsReferenced(job.input_sha256));
}

TEST_P(JobStoreConformance, ProgressNeverFalls) {
  Insert();
  const Job job = Claim();
  ASSERT_TRUE(*store_->ReportProgress(job.id, job.attempt, 60, "sweep", ++time_));
  ASSERT_TRUE(*store_->ReportProgress(job.id, job.attempt, 40, "encode", ++time_));
  EXPECT_EQ(store_->Find(job.id)->progress, 60);
  EXPECT_EQ(store_->Find(job.id)->message, "encode");
}

TEST_P(JobStoreConformance, MakesRunningJobsAcceptedAgain) {
  const Job waiting = Insert();
  const Job running = Claim();
  Reopen();
  EXPECT_EQ(*store_->RecoverRunning(++time_), 1);
  EXPECT_EQ(StateOf(running), JobState::kAccepted);
  EXPECT_EQ(Claim().id, waiting.id);
}

TEST_P(JobStoreConformance, OneKeyMakesOneJob) {
  const Job first = Insert("a", "key");
  NewJob again{NewJobId(++time_), "dem.tif", {{"levels", "2"}}, first.input_sha256, 5, "key"};
  const auto replayed = store_->Insert(again, time_);
  ASSERT_TRUE(replayed);
  EXPECT_EQ(replayed->id, first.id);
  again.input_sha256 = std::string(64, 'f');
  EXPECT_EQ(store_->Insert(again, time_).error().kind, "idempotency-key-reused");
  again.input_sha256 = first.input_sha256;
  again.parameters = {{"levels", "3"}};
  EXPECT_EQ(store_->Insert(again, time_).error().kind, "idempotency-key-reused");
  EXPECT_EQ(store_->List({{}, {}, 10})->jobs.size(), 1U);
}

TEST_P(JobStoreConformance, PagesThroughAllJobsNewestFirst) {
  std::vector<std::string> ids;
  for (int i = 0; i < 7; ++i) ids.insert(ids.begin(), Insert().id);
  std::vector<std::string> seen;
  JobQuery query{{}, {}, 3};
  for (;;) {
    const auto page = store_->List(query);
    ASSERT_TRUE(page);
    for (const Job& job : page->jobs) seen.push_back(job.id);
    if (!page->next) break;
    query.before = page->next;
    Insert();  // a job that is added between two pages is on neither
  }
  EXPECT_EQ(seen, ids);
}

TEST_P(JobStoreConformance, FiltersByState) {
  Insert();
  Insert();
  Claim();
  EXPECT_EQ(store_->List({{JobState::kRunning}, {}, 10})->jobs.size(), 1U);
  EXPECT_EQ(store_->List({{JobState::kRunning, JobState::kAccepted}, {}, 10})->jobs.size(), 2U);
  EXPECT_EQ(store_->List({{JobState::kFailed}, {}, 10})->jobs.size(), 0U);
  EXPECT_EQ(*store_->CountWaiting(), 1);
}

INSTANTIATE_TEST_SUITE_P(Sqlite, JobStoreConformance,
                         testing::Values([](const std::filesystem::path& folder) {
                           return OpenSqliteJobStore(folder / "jobs.sqlite");
                         }));

// The tables as version 1 of the schema had them, without what no row of this test needs.
constexpr const char* kVersion1 = R"(
CREATE TABLE jobs (
  id TEXT PRIMARY KEY,
  state TEXT NOT NULL CHECK (state IN ('accepted','running','successful','failed','dismissed')),
  filename TEXT NOT NULL, parameters TEXT NOT NULL, input_sha256 TEXT NOT NULL,
  input_bytes INTEGER NOT NULL,
  progress INTEGER NOT NULL DEFAULT 0 CHECK (progress BETWEEN 0 AND 100),
  message TEXT NOT NULL DEFAULT '', created_ms INTEGER NOT NULL, started_ms INTEGER,
  finished_ms INTEGER, updated_ms INTEGER NOT NULL, attempt INTEGER NOT NULL DEFAULT 0,
  crash_count INTEGER NOT NULL DEFAULT 0, failure_code TEXT, failure_kind TEXT,
  failure_message TEXT, timings TEXT NOT NULL DEFAULT '{}',
  CHECK ((finished_ms IS NOT NULL) = (state IN ('successful','failed','dismissed'))),
  CHECK ((failure_code IS NOT NULL) = (state = 'failed'))
) STRICT, WITHOUT ROWID;
CREATE TABLE artifacts (
  job_id TEXT NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
  name TEXT NOT NULL, media_type TEXT NOT NULL, bytes INTEGER NOT NULL, sha256 TEXT NOT NULL,
  PRIMARY KEY (job_id, name)
) STRICT, WITHOUT ROWID;
CREATE TABLE idempotency_keys (
  key TEXT PRIMARY KEY, job_id TEXT NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
  created_ms INTEGER NOT NULL
) STRICT, WITHOUT ROWID;
INSERT INTO jobs (id, state, filename, parameters, input_sha256, input_bytes, created_ms,
  updated_ms) VALUES ('old', 'accepted', 'a.tif', 'levels=2', 'x', 5, 1, 1);
PRAGMA application_id = 1179142739;
PRAGMA user_version = 1;
)";

TEST(SqliteJobStore, BringsAnOlderFileForward) {
  const TempDir folder;
  const auto path = folder / "jobs.sqlite";
  {
    Database database;
    database.Open(path);
    database.Execute(kVersion1);
  }
  for (int opened = 0; opened < 2; ++opened) {  // the second time there is nothing left to do
    auto store = OpenSqliteJobStore(path);
    ASSERT_TRUE(store) << store.error().message;
    const auto job = (*store)->Find("old");
    ASSERT_TRUE(job);
    EXPECT_EQ(job->parameters, (Parameters{{"levels", "2"}}));
    EXPECT_TRUE(job->assumptions.empty());
  }
  auto store = OpenSqliteJobStore(path);
  ASSERT_TRUE((*store)->ClaimNext(2));
  EXPECT_TRUE(*(*store)->ReportAssumptions("old", 1, {{"a", "b"}}, 3));
  EXPECT_EQ(CodesOf(*(*store)->Find("old")), std::vector<std::string>{"a"});
}

TEST(SqliteJobStore, RefusesAFileOfANewerVersion) {
  const TempDir folder;
  const auto path = folder / "jobs.sqlite";
  ASSERT_TRUE(OpenSqliteJobStore(path));
  {
    Database database;
    database.Open(path);
    database.Execute("PRAGMA user_version = 1000;");
  }
  auto opened = OpenSqliteJobStore(path);
  ASSERT_FALSE(opened);
  EXPECT_NE(opened.error().message.find("newer farhorizon"), std::string::npos);
}

TEST(SqliteJobStore, NeverStartsAfreshOverAFileThatItCannotRead) {
  const TempDir folder;
  const auto path = folder / "jobs.sqlite";
  SpillFile(path, std::string(8192, 'x'));
  auto opened = OpenSqliteJobStore(path);
  ASSERT_FALSE(opened);
  EXPECT_NE(opened.error().message.find("backup"), std::string::npos);
  EXPECT_EQ(SlurpFile(path), std::string(8192, 'x'));
}

TEST(SqliteJobStore, SeesAByteTurnedInItsPages) {
  const TempDir folder;
  const auto path = folder / "jobs.sqlite";
  {
    auto store = OpenSqliteJobStore(path);
    ASSERT_TRUE(store);
    ASSERT_TRUE((*store)->Insert({NewJobId(1), "a", {}, std::string(64, 'a'), 1, {}}, 1));
  }
  std::string bytes = SlurpFile(path);
  for (std::size_t i = 4096; i < 4096 + 64 && i < bytes.size(); ++i) bytes[i] = '\x5A';
  SpillFile(path, bytes);
  EXPECT_FALSE(OpenSqliteJobStore(path));
}

}  // namespace
}  // namespace farhorizon

// Data directories of every earlier version: made from the SQL that made them.
#include "service/jobs/sqlite_schema.h"

#include <string>

#include <gtest/gtest.h>

#include "service/jobs/sqlite_job_store.h"
#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

// The tables as version 1 of the schema had them.
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
CREATE INDEX jobs_by_state ON jobs (state, id);
CREATE INDEX jobs_by_input ON jobs (input_sha256);
CREATE TABLE artifacts (
  job_id TEXT NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
  name TEXT NOT NULL, media_type TEXT NOT NULL, bytes INTEGER NOT NULL, sha256 TEXT NOT NULL,
  PRIMARY KEY (job_id, name)
) STRICT, WITHOUT ROWID;
CREATE INDEX artifacts_by_object ON artifacts (sha256);
CREATE TABLE idempotency_keys (
  key TEXT PRIMARY KEY, job_id TEXT NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
  created_ms INTEGER NOT NULL
) STRICT, WITHOUT ROWID;
CREATE INDEX idempotency_keys_by_job ON idempotency_keys (job_id);
PRAGMA application_id = 1179142739;
PRAGMA user_version = 1;
)";
constexpr const char* kVersion2 = R"(
ALTER TABLE jobs ADD COLUMN assumptions TEXT NOT NULL DEFAULT '[]';
PRAGMA user_version = 2;
)";
constexpr const char* kVersion3 = R"(
ALTER TABLE jobs ADD COLUMN client TEXT NOT NULL DEFAULT '';
ALTER TABLE jobs ADD COLUMN run INTEGER NOT NULL DEFAULT 0;
ALTER TABLE jobs ADD COLUMN retries INTEGER NOT NULL DEFAULT 0;
ALTER TABLE jobs ADD COLUMN crashes INTEGER NOT NULL DEFAULT 0;
ALTER TABLE jobs ADD COLUMN not_before_ms INTEGER NOT NULL DEFAULT 0;
UPDATE jobs SET run = attempt;
CREATE INDEX jobs_by_client ON jobs (state, client, id);
CREATE INDEX jobs_by_end ON jobs (finished_ms, id) WHERE finished_ms IS NOT NULL;
CREATE TABLE garbage (sha256 TEXT PRIMARY KEY) STRICT, WITHOUT ROWID;
CREATE TABLE store (
  one INTEGER PRIMARY KEY CHECK (one = 1), id TEXT NOT NULL,
  generation INTEGER NOT NULL DEFAULT 0, pings INTEGER NOT NULL DEFAULT 0
) STRICT;
INSERT INTO store (one, id) VALUES (1, lower(hex(randomblob(16))));
PRAGMA user_version = 3;
)";
constexpr const char* kVersion4 = R"(
ALTER TABLE artifacts ADD COLUMN gzip_sha256 TEXT;
ALTER TABLE artifacts ADD COLUMN gzip_bytes INTEGER;
CREATE INDEX artifacts_by_gzip ON artifacts (gzip_sha256) WHERE gzip_sha256 IS NOT NULL;
PRAGMA user_version = 4;
)";
constexpr const char* kVersion5 = R"(
ALTER TABLE jobs ADD COLUMN priority INTEGER NOT NULL DEFAULT 1 CHECK (priority BETWEEN 0 AND 2);
ALTER TABLE jobs ADD COLUMN deadline_ms INTEGER;
ALTER TABLE jobs ADD COLUMN timeout_seconds INTEGER NOT NULL DEFAULT 0;
ALTER TABLE jobs ADD COLUMN cost_memory_bytes INTEGER NOT NULL DEFAULT 0;
ALTER TABLE jobs ADD COLUMN cost_seconds INTEGER NOT NULL DEFAULT 0;
CREATE INDEX jobs_by_priority ON jobs (priority, client, id) WHERE state = 'accepted';
CREATE INDEX jobs_by_deadline ON jobs (deadline_ms)
  WHERE state = 'accepted' AND deadline_ms IS NOT NULL;
PRAGMA user_version = 5;
)";
// One job in each state, with attempts behind it. The running one was cut off.
constexpr const char* kRows = R"(
INSERT INTO jobs (id, state, filename, parameters, input_sha256, input_bytes, progress, created_ms,
  started_ms, finished_ms, updated_ms, attempt, failure_code, failure_kind, failure_message) VALUES
 ('01900000-0000-7000-8000-000000000001', 'successful', 'a.tif', 'levels=2', 'x', 5, 100, 1000,
  2000, 3000, 3000, 1, NULL, NULL, NULL),
 ('01900000-0000-7000-8000-000000000002', 'failed', 'b.tif', '', 'x', 5, 10, 1000, 2000, 3000, 3000,
  2, 'unsupported-data', 'no-crs', 'why'),
 ('01900000-0000-7000-8000-000000000003', 'running', 'c.tif', '', 'x', 5, 40, 1000, 2000, NULL,
  4000, 3, NULL, NULL, NULL),
 ('01900000-0000-7000-8000-000000000004', 'accepted', 'd.tif', 'levels=3', 'x', 5, 0, 1000, NULL,
  NULL, 1000, 0, NULL, NULL, NULL);
INSERT INTO artifacts VALUES ('01900000-0000-7000-8000-000000000001', 'lod0.glb', 'a/b', 7, 'y');
INSERT INTO idempotency_keys VALUES ('k', '01900000-0000-7000-8000-000000000004', 1000);
)";

std::string Id(int number) {
  return "01900000-0000-7000-8000-00000000000" + std::to_string(number);
}

class SchemaTest : public testing::TestWithParam<int> {
 protected:
  void SetUp() override {
    Database database;
    database.Open(path_);
    database.Execute(kVersion1);
    if (GetParam() > 1) database.Execute(kVersion2);
    database.Execute(kRows);
    if (GetParam() > 2) database.Execute(kVersion3);
    if (GetParam() > 3) database.Execute(kVersion4);
    if (GetParam() > 4) database.Execute(kVersion5);
  }
  TempDir folder_;
  const std::filesystem::path path_ = folder_ / "jobs.sqlite";
};

TEST_P(SchemaTest, BringsAFileOfAnEarlierVersionForward) {
  for (int opened = 0; opened < 2; ++opened) {  // the second time there is nothing left to do
    auto store = OpenSqliteJobStore(path_);
    ASSERT_TRUE(store) << store.error().message;
    const auto done = (*store)->Find(Id(1));
    ASSERT_TRUE(done);
    EXPECT_EQ(done->state, JobState::kSuccessful);
    EXPECT_EQ(done->parameters, (Parameters{{"levels", "2"}}));
    EXPECT_EQ(done->attempt, 1);
    EXPECT_TRUE(done->assumptions.empty());
    EXPECT_EQ(done->priority, Priority::kNormal);
    EXPECT_FALSE(done->deadline_ms);
    EXPECT_EQ(done->process, kTerrainProcess);
    EXPECT_EQ(done->answer, "");
    EXPECT_EQ(done->cost.memory_bytes, 0) << "nobody knows";
    EXPECT_EQ(done->owner, "") << "of before there were keys";
    EXPECT_EQ((*store)->Artifacts(Id(1))->at(0).sha256, "y");
    EXPECT_EQ((*store)->Find(Id(2))->failure->kind, "no-crs");
    EXPECT_EQ((*store)->List({{}, {}, 10})->jobs.size(), 4U);
    EXPECT_EQ((*store)->Identity()->id.size(), 32U);
    EXPECT_EQ((*store)->Identity()->generation, 0);
  }
}

TEST_P(SchemaTest, GoesOnWhereAnEarlierVersionStopped) {
  auto store = OpenSqliteJobStore(path_);
  ASSERT_TRUE(store);
  EXPECT_EQ(*(*store)->RecoverRunning(PreviousEnd::kKilled, 5000), 1);
  const auto next = (*store)->ClaimNext(5001, {});
  ASSERT_TRUE(next && *next);
  EXPECT_EQ((*next)->id, Id(3));
  EXPECT_EQ((*next)->run, 4) << "an earlier version counted runs as attempts";
  EXPECT_TRUE(*(*store)->ReportAssumptions(Id(3), 4, {{"a", "b"}}, 5002));
  const NewJob again{"d.tif", {{"levels", "3"}}, "x", 5, "k"};
  EXPECT_EQ((*store)->Insert(again, {}, 5003)->id, Id(4));
}

INSTANTIATE_TEST_SUITE_P(Versions, SchemaTest, testing::Values(1, 2, 3, 4, 5));

}  // namespace
}  // namespace farhorizon

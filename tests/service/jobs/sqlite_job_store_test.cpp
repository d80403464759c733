#include "service/jobs/sqlite_job_store.h"

#include <gtest/gtest.h>

#include "service/jobs/sqlite.h"
#include "tests/service/jobs/job_store_conformance.h"
#include "tests/service/jobs/upload_conformance.h"
#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

class SqliteStorage : public JobStorage {
 public:
  explicit SqliteStorage(const std::filesystem::path& folder) : path_(folder / "jobs.sqlite") {}
  Result<std::unique_ptr<JobStore>> Open() override { return OpenSqliteJobStore(path_); }
  void Start(const std::string& client) override {
    Database database;
    database.Open(path_);
    Statement(database, "UPDATE jobs SET state = 'running', run = 1, attempt = 1 WHERE client = ?")
        .Bind(client)
        .Run();
  }

 private:
  std::filesystem::path path_;
};

std::unique_ptr<JobStorage> MakeSqliteStorage(const std::filesystem::path& folder) {
  return std::make_unique<SqliteStorage>(folder);
}

INSTANTIATE_TEST_SUITE_P(Sqlite, JobStoreConformance, testing::Values(MakeSqliteStorage));
INSTANTIATE_TEST_SUITE_P(Sqlite, Choice, testing::Values(MakeSqliteStorage));
INSTANTIATE_TEST_SUITE_P(Sqlite, Expiry, testing::Values(MakeSqliteStorage));
INSTANTIATE_TEST_SUITE_P(Sqlite, UploadConformance, testing::Values(MakeSqliteStorage));
INSTANTIATE_TEST_SUITE_P(Sqlite, Outbox, testing::Values(MakeSqliteStorage));

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

TEST(SqliteJobStore, GoesOnWithAFirstStartThatWasCutOffBeforeItsTables) {
  const TempDir folder;
  const auto path = folder / "jobs.sqlite";
  {
    Database database;
    database.Open(path);
    database.Execute("PRAGMA journal_mode = WAL;");  // writes the first page
    ASSERT_GT(database.Pragma("page_count"), 0);
  }
  EXPECT_TRUE(OpenSqliteJobStore(path));
}

TEST(SqliteJobStore, RefusesADatabaseOfAnotherProgram) {
  const TempDir folder;
  const auto path = folder / "jobs.sqlite";
  {
    Database database;
    database.Open(path);
    database.Execute("CREATE TABLE theirs (x);");
  }
  auto opened = OpenSqliteJobStore(path);
  ASSERT_FALSE(opened);
  EXPECT_NE(opened.error().message.find("no job store of farhorizon"), std::string::npos);
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

TEST(SqliteJobStore, ADamagedRowHidesNoOtherAndDoesNotRun) {
  const TempDir folder;
  const auto path = folder / "jobs.sqlite";
  auto store = OpenSqliteJobStore(path);
  ASSERT_TRUE(store);
  for (const char* name : {"a", "b"}) {
    ASSERT_TRUE((*store)->Insert({name, {}, std::string(64, 'a'), 1, {}}, {}, 1));
  }
  store = OpenSqliteJobStore(folder / "other.sqlite");  // closes the file
  {
    Database database;
    database.Open(path);
    database.Execute(
        "UPDATE jobs SET parameters = '%', timings = '[', assumptions = '{\"a\":[[' || char(0) "
        "WHERE filename = 'a'");
  }
  store = OpenSqliteJobStore(path);
  ASSERT_TRUE(store);
  EXPECT_EQ((*store)->List({{}, {}, 10})->jobs.size(), 2U);
  const auto claimed = (*store)->ClaimNext(2, {});
  ASSERT_TRUE(claimed && *claimed);
  ASSERT_TRUE((*claimed)->failure) << "its parameters are lost: it must not run with others";
  EXPECT_EQ((*claimed)->failure->kind, "job-store");
}

TEST(SqliteJobStore, SeesAByteTurnedInItsPages) {
  const TempDir folder;
  const auto path = folder / "jobs.sqlite";
  {
    auto store = OpenSqliteJobStore(path);
    ASSERT_TRUE(store);
    ASSERT_TRUE((*store)->Insert({"a", {}, std::string(64, 'a'), 1, {}}, {}, 1));
  }
  std::string bytes = SlurpFile(path);
  for (std::size_t i = 4096; i < 4096 + 64 && i < bytes.size(); ++i) bytes[i] = '\x5A';
  SpillFile(path, bytes);
  EXPECT_FALSE(OpenSqliteJobStore(path));
}

}  // namespace
}  // namespace farhorizon

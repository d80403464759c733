// The embedded job store: SqlJobStore with calls that write under one mutex, and those that answer
// clients beside it. The tables are in sqlite_schema.h; sqlite.h has the wrapper of SQLite.
#include "service/jobs/sqlite_job_store.h"

#include <algorithm>
#include <mutex>
#include <string>
#include <utility>

#include "service/jobs/sql_job_store.h"
#include "service/jobs/sql_rows.h"
#include "service/jobs/sqlite.h"
#include "service/jobs/sqlite_readers.h"
#include "service/jobs/sqlite_schema.h"

namespace farhorizon {

namespace {

class SqliteJobStore : public SqlJobStore {
 public:
  Status Open(const std::filesystem::path& path);

  Result<StoreIdentity> BeginGeneration() override;
  Status Ping() override;

 private:
  // Beside whoever writes.
  Status RunRead(const Reading& work) override;
  // Under the mutex.
  Status RunCall(const Writing& work) override;
  // One statement is a transaction.
  Status RunWrite(const Writing& work) override { return RunCall(work); }
  std::int64_t Later(const SqlDatabase& /*database*/, std::int64_t now_ms) override {
    return latest_ms_ = std::max(latest_ms_, now_ms);
  }
  void ChangedHere(const std::string& id) override { Changed(id); }

  std::mutex mutex_;
  Database database_;
  SqliteReaders readers_;
  std::int64_t latest_ms_ = 0;
};

Error Unusable(const std::string& why, const std::string& remedy) {
  return {ErrorCode::kIo, "job store: " + why + "; " + remedy, "job-store-unusable"};
}

Status SqliteJobStore::Open(const std::filesystem::path& path) {
  const std::lock_guard lock(mutex_);
  try {
    database_.Open(path);
  } catch (SqlFailure& failure) {
    return std::move(failure.error);
  }
  try {
    PrepareSchema(database_);
    Statement latest(database_, "SELECT max(updated_ms) FROM jobs");
    if (latest.Step()) latest_ms_ = latest.Integer(0);
    readers_.Open(path);
  } catch (SqlFailure& failure) {
    // Of these, the message says the remedy.
    const ErrorKind kind = failure.error.kind;
    if (kind == "no-space" || kind == "job-store-unusable") return std::move(failure.error);
    return Unusable(failure.error.message,
                    "it may be damaged: restore it from a backup, let `farhorizon fsck DIR "
                    "--repair` take out of it what can be read, or move the data directory away "
                    "to start afresh");
  }
  return Ok{};
}

Status SqliteJobStore::RunRead(const Reading& work) {
  try {
    readers_.Read([&work](const Database& database) { work(database); });
    return Ok{};
  } catch (SqlFailure& failure) {
    return std::move(failure.error);
  }
}

Status SqliteJobStore::RunCall(const Writing& work) {
  const std::lock_guard lock(mutex_);
  try {
    work(database_);
    return Ok{};
  } catch (SqlFailure& failure) {
    return std::move(failure.error);
  }
}

Result<StoreIdentity> SqliteJobStore::BeginGeneration() {
  return Call([](const SqlDatabase& database) {
    Statement(database, "UPDATE store SET generation = generation + 1").Run();
    // Else the count would be lost with the write-ahead log, and the store taken for an older one.
    Statement(database, "PRAGMA wal_checkpoint(TRUNCATE)").Run();
    return SelectIdentity(database);
  });
}

Status SqliteJobStore::Ping() {
  return Call([](const SqlDatabase& database) {
    Statement(database, "UPDATE store SET pings = pings + 1").Run();
    return Ok{};
  });
}

}  // namespace

Result<std::unique_ptr<JobStore>> OpenSqliteJobStore(const std::filesystem::path& path) {
  auto store = std::make_unique<SqliteJobStore>();
  Status opened = store->Open(path);
  if (!opened) return std::move(opened.error());
  return std::unique_ptr<JobStore>(std::move(store));
}

}  // namespace farhorizon

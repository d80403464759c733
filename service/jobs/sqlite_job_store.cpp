// The embedded job store: calls that write under one mutex, those that answer clients beside it.
// The statements of the queue are in sql_queue.h and sql_claim.h, of running jobs in
// sql_runs.h, those that remove jobs in sql_removal.h, the rows in sql_rows.h, the tables
// in sqlite_schema.h; sqlite.h has the wrapper of SQLite.
#include "service/jobs/sqlite_job_store.h"

#include <algorithm>
#include <mutex>
#include <string>
#include <utility>

#include "service/jobs/sql_callbacks.h"
#include "service/jobs/sql_claim.h"
#include "service/jobs/sql_queue.h"
#include "service/jobs/sql_removal.h"
#include "service/jobs/sql_rows.h"
#include "service/jobs/sql_runs.h"
#include "service/jobs/sqlite.h"
#include "service/jobs/sqlite_readers.h"
#include "service/jobs/sqlite_schema.h"

namespace farhorizon {

namespace {

class SqliteJobStore : public JobStore {
 public:
  Status Open(const std::filesystem::path& path);

  Result<Job> Insert(const NewJob& job, const QueueBounds& bounds, std::int64_t now_ms) override;
  Result<std::optional<Job>> FindEarlier(const NewJob& job, std::int64_t now_ms) override;
  Status CheckQueue(const std::string& client, const QueueBounds& bounds) override;
  Result<Job> Find(const std::string& id) override;
  Result<JobPage> List(const JobQuery& query) override;
  Result<UnfinishedJobs> CountUnfinished() override;
  Result<std::optional<Job>> ClaimNext(std::int64_t now_ms, const MemoryRoom& room) override;
  Result<std::vector<std::string>> FailOverdue(std::int64_t now_ms) override;
  Result<bool> ReportProgress(const std::string& id, std::int64_t run, int progress,
                              const std::string& message, std::int64_t now_ms) override;
  Result<bool> ReportAssumptions(const std::string& id, std::int64_t run,
                                 const Assumptions& assumptions, std::int64_t now_ms) override;
  Result<bool> Publish(const std::string& id, std::int64_t run,
                       const std::vector<Artifact>& artifacts,
                       const std::map<std::string, double>& timings, std::int64_t now_ms) override;
  Result<bool> Fail(const std::string& id, std::int64_t run, const Error& failure,
                    std::int64_t now_ms) override;
  Result<bool> Requeue(const std::string& id, std::int64_t run, RequeueReason reason,
                       std::int64_t now_ms) override;
  Result<bool> RequeueWithMemory(const std::string& id, std::int64_t run, std::int64_t memory_bytes,
                                 std::int64_t now_ms) override;
  Result<bool> Postpone(const std::string& id, std::int64_t run, std::int64_t delay_ms,
                        std::int64_t now_ms) override;
  Result<Job> Dismiss(const std::string& id, std::int64_t now_ms) override;
  Result<std::int64_t> RemoveExpired(const Retention& retention, std::int64_t now_ms) override;
  Result<std::int64_t> RecoverRunning(PreviousEnd end, std::int64_t now_ms) override;
  Result<std::optional<DueCallback>> ClaimCallback(std::chrono::milliseconds lease,
                                                   std::int64_t now_ms) override;
  Result<bool> EndCallback(const DueCallback& callback, CallbackEnd end) override;
  Result<bool> RetryCallback(const DueCallback& callback, std::chrono::milliseconds delay,
                             std::int64_t now_ms) override;
  Result<std::vector<Artifact>> Artifacts(const std::string& id) override;
  Result<bool> IsReferenced(const std::string& sha256) override;
  Result<std::vector<std::string>> Garbage() override;
  Status ForgetGarbage(const std::vector<std::string>& names) override;
  Result<StoreIdentity> Identity() override;
  Result<StoreIdentity> BeginGeneration() override;
  Status Ping() override;
  Status Transact(const std::function<Status(SqlDatabase&)>& work) override;

 private:
  // Runs `work` under the mutex; returns a SqlFailure as its Error.
  template <typename Work>
  auto Guarded(Work work) -> decltype(work()) {
    const std::lock_guard lock(mutex_);
    try {
      return work();
    } catch (SqlFailure& failure) {
      return std::move(failure.error);
    }
  }
  // The same for work that has no Error of its own to return.
  template <typename Work>
  auto Call(Work work) -> Result<decltype(work())> {
    return Guarded([&]() -> Result<decltype(work())> { return work(); });
  }
  // The same for a change of the job that is told to the listener.
  template <typename Work>
  Result<bool> Change(const std::string& id, Work work) {
    const Result<bool> changed = Call(work);
    if (changed && *changed) Changed(id);
    return changed;
  }
  // The same for a change of as many jobs as `work` says.
  template <typename Work>
  Result<std::int64_t> ChangeSome(Work work) {
    const Result<std::int64_t> changed = Call(work);
    if (changed && *changed > 0) Changed("");
    return changed;
  }
  // Runs work(connection) beside whoever writes.
  template <typename Work>
  auto Read(Work work) -> decltype(work(std::declval<const Database&>())) {
    try {
      return readers_.Read(work);
    } catch (SqlFailure& failure) {
      return std::move(failure.error);
    }
  }
  // The time for a row that is written now: never before one that the store has. Requires: the
  // mutex is held.
  std::int64_t Later(std::int64_t now_ms) { return latest_ms_ = std::max(latest_ms_, now_ms); }

  std::mutex mutex_;
  Database database_;
  SqliteReaders readers_;
  StartTurns turns_;
  std::int64_t latest_ms_ = 0;
};

Error Unusable(const std::string& why, const std::string& remedy) {
  return {ErrorCode::kIo, "job store: " + why + "; " + remedy, "job-store-unusable"};
}

Status SqliteJobStore::Open(const std::filesystem::path& path) {
  return Guarded([&]() -> Status {
    database_.Open(path);
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
  });
}

Result<Job> SqliteJobStore::Insert(const NewJob& job, const QueueBounds& bounds,
                                   std::int64_t now_ms) {
  return Guarded([&]() -> Result<Job> {
    Transaction transaction(database_);
    Result<Job> stored = InsertInQueue(database_, job, bounds, Later(now_ms));
    if (stored) transaction.Commit();
    return stored;
  });
}

Result<std::optional<Job>> SqliteJobStore::FindEarlier(const NewJob& job, std::int64_t now_ms) {
  return Read([&](const Database& database) -> Result<std::optional<Job>> {
    return FindEarlierJob(database, job, now_ms);
  });
}

Status SqliteJobStore::CheckQueue(const std::string& client, const QueueBounds& bounds) {
  return Read([&](const Database& database) -> Status {
    return farhorizon::CheckQueue(database, client, bounds);
  });
}

Result<Job> SqliteJobStore::Find(const std::string& id) {
  return Read([&](const Database& database) -> Result<Job> {
    std::optional<Job> job = SelectJob(database, id);
    if (!job) return NoSuchJob();
    return *std::move(job);
  });
}

Result<JobPage> SqliteJobStore::List(const JobQuery& query) {
  return Read(
      [&](const Database& database) -> Result<JobPage> { return SelectPage(database, query); });
}

Result<UnfinishedJobs> SqliteJobStore::CountUnfinished() {
  return Read([&](const Database& database) -> Result<UnfinishedJobs> {
    return CountUnfinishedJobs(database);
  });
}

Result<std::optional<Job>> SqliteJobStore::ClaimNext(std::int64_t now_ms, const MemoryRoom& room) {
  Result<std::optional<Job>> job =
      Call([&] { return ClaimJob(database_, turns_, room, Later(now_ms)); });
  if (job && *job) Changed((*job)->id);
  return job;
}

Result<std::vector<std::string>> SqliteJobStore::FailOverdue(std::int64_t now_ms) {
  Result<std::vector<std::string>> failed =
      Call([&] { return FailOverdueJobs(database_, Later(now_ms)); });
  if (failed) std::for_each(failed->begin(), failed->end(), [&](auto& id) { Changed(id); });
  return failed;
}

Result<bool> SqliteJobStore::ReportProgress(const std::string& id, std::int64_t run, int progress,
                                            const std::string& message, std::int64_t now_ms) {
  return Change(id, [&] {
    return StoreProgress(database_, {id, run, Later(now_ms)}, progress, message);
  });
}

Result<bool> SqliteJobStore::ReportAssumptions(const std::string& id, std::int64_t run,
                                               const Assumptions& assumptions,
                                               std::int64_t now_ms) {
  return Change(id, [&] {
    return StoreAssumptions(database_, {id, run, Later(now_ms)}, assumptions);
  });
}

Result<bool> SqliteJobStore::Publish(const std::string& id, std::int64_t run,
                                     const std::vector<Artifact>& artifacts,
                                     const std::map<std::string, double>& timings,
                                     std::int64_t now_ms) {
  return Change(id, [&] {
    return PublishRun(database_, {id, run, Later(now_ms)}, artifacts, timings);
  });
}

Result<bool> SqliteJobStore::Fail(const std::string& id, std::int64_t run, const Error& failure,
                                  std::int64_t now_ms) {
  return Change(id, [&] { return FailRun(database_, {id, run, Later(now_ms)}, failure); });
}

Result<bool> SqliteJobStore::Requeue(const std::string& id, std::int64_t run, RequeueReason reason,
                                     std::int64_t now_ms) {
  return Change(id, [&] { return RequeueRun(database_, {id, run, Later(now_ms)}, reason); });
}

Result<bool> SqliteJobStore::RequeueWithMemory(const std::string& id, std::int64_t run,
                                               std::int64_t memory_bytes, std::int64_t now_ms) {
  return Change(id, [&] {
    return farhorizon::RequeueWithMemory(database_, {id, run, Later(now_ms)}, memory_bytes);
  });
}

Result<bool> SqliteJobStore::Postpone(const std::string& id, std::int64_t run,
                                      std::int64_t delay_ms, std::int64_t now_ms) {
  return Change(id, [&] { return PostponeRun(database_, {id, run, Later(now_ms)}, delay_ms); });
}

Result<Job> SqliteJobStore::Dismiss(const std::string& id, std::int64_t now_ms) {
  Result<Job> job =
      Guarded([&]() -> Result<Job> { return DismissJob(database_, id, Later(now_ms)); });
  if (job) Changed(id);
  return job;
}

Result<std::int64_t> SqliteJobStore::RemoveExpired(const Retention& retention,
                                                   std::int64_t now_ms) {
  return ChangeSome([&] { return RemoveExpiredJobs(database_, retention, now_ms); });
}

Result<std::int64_t> SqliteJobStore::RecoverRunning(PreviousEnd end, std::int64_t now_ms) {
  return ChangeSome([&] { return RecoverJobs(database_, end, Later(now_ms)); });
}

Result<std::optional<DueCallback>> SqliteJobStore::ClaimCallback(std::chrono::milliseconds lease,
                                                                 std::int64_t now_ms) {
  return Call([&] { return farhorizon::ClaimCallback(database_, lease, now_ms); });
}

Result<bool> SqliteJobStore::EndCallback(const DueCallback& callback, CallbackEnd end) {
  return Call([&] { return farhorizon::EndCallback(database_, callback, end); });
}

Result<bool> SqliteJobStore::RetryCallback(const DueCallback& callback,
                                           std::chrono::milliseconds delay, std::int64_t now_ms) {
  return Call([&] { return farhorizon::RetryCallback(database_, callback, delay, now_ms); });
}

Result<std::vector<Artifact>> SqliteJobStore::Artifacts(const std::string& id) {
  return Read([&](const Database& database) -> Result<std::vector<Artifact>> {
    return SelectArtifacts(database, id);
  });
}

Result<bool> SqliteJobStore::IsReferenced(const std::string& sha256) {
  return Call([&] { return farhorizon::IsReferenced(database_, sha256); });
}

Result<std::vector<std::string>> SqliteJobStore::Garbage() {
  return Call([&] { return SelectGarbage(database_); });
}

Status SqliteJobStore::ForgetGarbage(const std::vector<std::string>& names) {
  return Call([&] {
    farhorizon::ForgetGarbage(database_, names);
    return Ok{};
  });
}

Result<StoreIdentity> SqliteJobStore::Identity() {
  return Call([&] { return SelectIdentity(database_); });
}

Result<StoreIdentity> SqliteJobStore::BeginGeneration() {
  return Call([&] {
    Statement(database_, "UPDATE store SET generation = generation + 1").Run();
    // Else the count would be lost with the write-ahead log, and the store taken for an older one.
    Statement(database_, "PRAGMA wal_checkpoint(TRUNCATE)").Run();
    return SelectIdentity(database_);
  });
}

Status SqliteJobStore::Ping() {
  return Call([&] {
    Statement(database_, "UPDATE store SET pings = pings + 1").Run();
    return Ok{};
  });
}

Status SqliteJobStore::Transact(const std::function<Status(SqlDatabase&)>& work) {
  return Guarded([&]() -> Status {
    Transaction transaction(database_);
    Status done = work(database_);
    if (done) transaction.Commit();
    return done;
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

// The embedded job store: the statements of each call of JobStore. sqlite.h has the wrapper of
// SQLite, sqlite_schema.h the tables, sqlite_rows.h the rows.
#include "service/jobs/sqlite_job_store.h"

#include <mutex>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include "service/jobs/sqlite.h"
#include "service/jobs/sqlite_rows.h"
#include "service/jobs/sqlite_schema.h"

namespace farhorizon {

namespace {

// How long a client may wait before it sends a submission again
// (draft-ietf-httpapi-idempotency-key-header).
constexpr std::int64_t kIdempotencyKeepMs = std::int64_t{7} * 24 * 3600 * 1000;

class SqliteJobStore : public JobStore {
 public:
  Status Open(const std::filesystem::path& path);

  Result<Job> Insert(const NewJob& job, std::int64_t now_ms) override;
  Result<Job> Find(const std::string& id) override;
  Result<JobPage> List(const JobQuery& query) override;
  Result<std::int64_t> CountWaiting() override;
  Result<std::optional<Job>> ClaimNext(std::int64_t now_ms) override;
  Result<bool> ReportProgress(const std::string& id, std::int64_t attempt, int progress,
                              const std::string& message, std::int64_t now_ms) override;
  Result<bool> ReportAssumptions(const std::string& id, std::int64_t attempt,
                                 const Assumptions& assumptions, std::int64_t now_ms) override;
  Result<bool> Publish(const std::string& id, std::int64_t attempt,
                       const std::vector<Artifact>& artifacts,
                       const std::map<std::string, double>& timings, std::int64_t now_ms) override;
  Result<bool> Fail(const std::string& id, std::int64_t attempt, const Error& failure,
                    std::int64_t now_ms) override;
  Result<bool> Requeue(const std::string& id, std::int64_t attempt, RequeueReason reason,
                       std::int64_t now_ms) override;
  Result<Job> Dismiss(const std::string& id, std::int64_t now_ms) override;
  Result<std::int64_t> RecoverRunning(std::int64_t now_ms) override;
  Result<std::vector<Artifact>> Artifacts(const std::string& id) override;
  Result<bool> IsReferenced(const std::string& sha256) override;
  Status Ping() override;

 private:
  // Runs `work` under the mutex; returns a SqliteFailure as its Error.
  template <typename Work>
  auto Guarded(Work work) -> decltype(work()) {
    const std::lock_guard lock(mutex_);
    try {
      return work();
    } catch (SqliteFailure& failure) {
      return std::move(failure.error);
    }
  }

  std::mutex mutex_;
  Database database_;
};

Error Unusable(const std::string& why, const std::string& remedy) {
  return {ErrorCode::kIo, "job store: " + why + "; " + remedy, "job-store-unusable"};
}

Status SqliteJobStore::Open(const std::filesystem::path& path) {
  return Guarded([&]() -> Status {
    database_.Open(path);
    try {
      PrepareSchema(database_);
    } catch (SqliteFailure& failure) {
      return Unusable(failure.error.message,
                      "it may be damaged: restore it from a backup, or move the data directory "
                      "away to start afresh");
    }
    return Ok{};
  });
}

// The job `id`, which an earlier submission with the idempotency key of `job` has made.
Result<Job> EarlierJob(const Database& database, const std::string& id, const NewJob& job) {
  const std::optional<Job> earlier = SelectJob(database, id);
  if (earlier && earlier->input_sha256 == job.input_sha256 && earlier->filename == job.filename &&
      earlier->parameters == job.parameters) {
    return *earlier;
  }
  return Error{ErrorCode::kInvalidArgument,
               "this Idempotency-Key came with another DEM or other parameters before; "
               "send a new key with a new job",
               "idempotency-key-reused"};
}

Result<Job> SqliteJobStore::Insert(const NewJob& job, std::int64_t now_ms) {
  return Guarded([&]() -> Result<Job> {
    Transaction transaction(database_);
    if (job.idempotency_key) {
      Statement(database_, "DELETE FROM idempotency_keys WHERE created_ms < ?")
          .Bind(now_ms - kIdempotencyKeepMs)
          .Run();
      Statement known(database_, "SELECT job_id FROM idempotency_keys WHERE key = ?");
      if (known.Bind(*job.idempotency_key).Step()) return EarlierJob(database_, known.Text(0), job);
    }
    InsertJob(database_, job, now_ms);
    if (job.idempotency_key) {
      Statement key(database_,
                    "INSERT INTO idempotency_keys (key, job_id, created_ms) VALUES (?, ?, ?)");
      key.Bind(*job.idempotency_key).Bind(job.id).Bind(now_ms).Run();
    }
    std::optional<Job> stored = SelectJob(database_, job.id);
    Check(stored.has_value(), "an inserted job is there");
    transaction.Commit();
    return *std::move(stored);
  });
}

Result<Job> SqliteJobStore::Find(const std::string& id) {
  return Guarded([&]() -> Result<Job> {
    std::optional<Job> job = SelectJob(database_, id);
    if (!job) return NoSuchJob();
    return *std::move(job);
  });
}

Result<JobPage> SqliteJobStore::List(const JobQuery& query) {
  return Guarded([&]() -> Result<JobPage> { return SelectPage(database_, query); });
}

Result<std::int64_t> SqliteJobStore::CountWaiting() {
  return Guarded([&]() -> Result<std::int64_t> {
    Statement count(database_, "SELECT count(*) FROM jobs WHERE state = 'accepted'");
    count.Step();
    return count.Integer(0);
  });
}

Result<std::optional<Job>> SqliteJobStore::ClaimNext(std::int64_t now_ms) {
  return Guarded([&]() -> Result<std::optional<Job>> {
    Statement claim(database_,
                    std::string("UPDATE jobs SET state = 'running', attempt = attempt + 1, "
                                "started_ms = coalesce(started_ms, ?), updated_ms = ?, "
                                "message = 'starting' WHERE id = (SELECT id FROM jobs WHERE "
                                "state = 'accepted' ORDER BY id LIMIT 1) RETURNING ") +
                        kJobColumns);
    claim.Bind(now_ms).Bind(now_ms);
    std::optional<Job> job;
    while (claim.Step()) job = ReadJob(claim);
    return job;
  });
}

Result<bool> SqliteJobStore::ReportProgress(const std::string& id, std::int64_t attempt,
                                            int progress, const std::string& message,
                                            std::int64_t now_ms) {
  return Guarded([&]() -> Result<bool> {
    Statement update(database_,
                     "UPDATE jobs SET progress = max(progress, ?), message = ?, updated_ms = ? "
                     "WHERE id = ? AND attempt = ? AND state = 'running'");
    update.Bind(std::int64_t{progress}).Bind(message).Bind(now_ms).Bind(id).Bind(attempt);
    return update.Run() == 1;
  });
}

Result<bool> SqliteJobStore::ReportAssumptions(const std::string& id, std::int64_t attempt,
                                               const Assumptions& assumptions,
                                               std::int64_t now_ms) {
  return Guarded([&]() -> Result<bool> {
    Statement update(database_,
                     "UPDATE jobs SET assumptions = ?, updated_ms = ? "
                     "WHERE id = ? AND attempt = ? AND state = 'running'");
    update.Bind(AssumptionsColumn(assumptions)).Bind(now_ms).Bind(id).Bind(attempt);
    return update.Run() == 1;
  });
}

Result<bool> SqliteJobStore::Publish(const std::string& id, std::int64_t attempt,
                                     const std::vector<Artifact>& artifacts,
                                     const std::map<std::string, double>& timings,
                                     std::int64_t now_ms) {
  return Guarded([&]() -> Result<bool> {
    Transaction transaction(database_);
    Statement update(database_,
                     "UPDATE jobs SET state = 'successful', progress = 100, message = 'done', "
                     "finished_ms = ?, updated_ms = ?, timings = ? "
                     "WHERE id = ? AND attempt = ? AND state = 'running'");
    update.Bind(now_ms).Bind(now_ms).Bind(nlohmann::json(timings).dump()).Bind(id).Bind(attempt);
    if (update.Run() != 1) return false;
    for (const Artifact& artifact : artifacts) InsertArtifact(database_, id, artifact);
    transaction.Commit();
    return true;
  });
}

Result<bool> SqliteJobStore::Fail(const std::string& id, std::int64_t attempt, const Error& failure,
                                  std::int64_t now_ms) {
  return Guarded([&]() -> Result<bool> {
    Statement update(database_,
                     "UPDATE jobs SET state = 'failed', message = ?, failure_code = ?, "
                     "failure_kind = ?, failure_message = ?, finished_ms = ?, updated_ms = ? "
                     "WHERE id = ? AND attempt = ? AND state = 'running'");
    update.Bind(failure.message).Bind(std::string(ErrorCodeName(failure.code)));
    update.Bind(std::string(failure.kind)).Bind(failure.message).Bind(now_ms).Bind(now_ms);
    return update.Bind(id).Bind(attempt).Run() == 1;
  });
}

Result<bool> SqliteJobStore::Requeue(const std::string& id, std::int64_t attempt,
                                     RequeueReason reason, std::int64_t now_ms) {
  return Guarded([&]() -> Result<bool> {
    Statement update(database_,
                     "UPDATE jobs SET state = 'accepted', message = 'waiting to run again', "
                     "crash_count = crash_count + ?, updated_ms = ? "
                     "WHERE id = ? AND attempt = ? AND state = 'running'");
    update.Bind(std::int64_t{reason == RequeueReason::kWorkerCrashed ? 1 : 0}).Bind(now_ms);
    return update.Bind(id).Bind(attempt).Run() == 1;
  });
}

Result<Job> SqliteJobStore::Dismiss(const std::string& id, std::int64_t now_ms) {
  return Guarded([&]() -> Result<Job> {
    Transaction transaction(database_);
    std::optional<Job> job = SelectJob(database_, id);
    if (!job) return NoSuchJob();
    if (IsTerminal(job->state)) {
      Statement(database_, "DELETE FROM jobs WHERE id = ?").Bind(id).Run();
      job->state = JobState::kDismissed;
      job->failure.reset();
      job->message = "removed";
    } else {
      Statement update(database_,
                       "UPDATE jobs SET state = 'dismissed', message = 'dismissed', "
                       "finished_ms = ?, updated_ms = ? WHERE id = ?");
      update.Bind(now_ms).Bind(now_ms).Bind(id).Run();
      job = SelectJob(database_, id);
    }
    transaction.Commit();
    return *std::move(job);
  });
}

Result<std::int64_t> SqliteJobStore::RecoverRunning(std::int64_t now_ms) {
  return Guarded([&]() -> Result<std::int64_t> {
    Statement update(database_,
                     "UPDATE jobs SET state = 'accepted', message = 'waiting to run again', "
                     "updated_ms = ? WHERE state = 'running'");
    return std::int64_t{update.Bind(now_ms).Run()};
  });
}

Result<std::vector<Artifact>> SqliteJobStore::Artifacts(const std::string& id) {
  return Guarded([&]() -> Result<std::vector<Artifact>> { return SelectArtifacts(database_, id); });
}

Result<bool> SqliteJobStore::IsReferenced(const std::string& sha256) {
  return Guarded([&]() -> Result<bool> {
    Statement row(database_,
                  "SELECT 1 FROM jobs WHERE input_sha256 = ? UNION ALL "
                  "SELECT 1 FROM artifacts WHERE sha256 = ? LIMIT 1");
    return row.Bind(sha256).Bind(sha256).Step();
  });
}

Status SqliteJobStore::Ping() {
  return Guarded([&]() -> Status {
    Transaction transaction(database_);
    transaction.Commit();
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

// The embedded job store. One file knows SQLite, and this is it: a statement wrapper, the schema,
// the rows, the calls.
#include "service/jobs/sqlite_job_store.h"

#include <mutex>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>
#include <sqlite3.h>

namespace farhorizon {

namespace {

constexpr int kApplicationId = 0x46484A53;  // "FHJS"
constexpr int kSchemaVersion = 1;
/// A retry of a submission may come this long after it (draft-ietf-httpapi-idempotency-key-header).
constexpr std::int64_t kIdempotencyKeepMs = std::int64_t{7} * 24 * 3600 * 1000;

constexpr const char* kSchema = R"(
CREATE TABLE jobs (
  id TEXT PRIMARY KEY,
  state TEXT NOT NULL CHECK (state IN ('accepted','running','successful','failed','dismissed')),
  filename TEXT NOT NULL,
  parameters TEXT NOT NULL,
  input_sha256 TEXT NOT NULL,
  input_bytes INTEGER NOT NULL,
  progress INTEGER NOT NULL DEFAULT 0 CHECK (progress BETWEEN 0 AND 100),
  message TEXT NOT NULL DEFAULT '',
  created_ms INTEGER NOT NULL,
  started_ms INTEGER,
  finished_ms INTEGER,
  updated_ms INTEGER NOT NULL,
  attempt INTEGER NOT NULL DEFAULT 0,
  crash_count INTEGER NOT NULL DEFAULT 0,
  failure_code TEXT,
  failure_kind TEXT,
  failure_message TEXT,
  timings TEXT NOT NULL DEFAULT '{}',
  CHECK ((finished_ms IS NOT NULL) = (state IN ('successful','failed','dismissed'))),
  CHECK ((failure_code IS NOT NULL) = (state = 'failed'))
) STRICT, WITHOUT ROWID;
CREATE INDEX jobs_by_state ON jobs (state, id);
CREATE INDEX jobs_by_input ON jobs (input_sha256);
CREATE TABLE artifacts (
  job_id TEXT NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
  name TEXT NOT NULL,
  media_type TEXT NOT NULL,
  bytes INTEGER NOT NULL,
  sha256 TEXT NOT NULL,
  PRIMARY KEY (job_id, name)
) STRICT, WITHOUT ROWID;
CREATE INDEX artifacts_by_object ON artifacts (sha256);
CREATE TABLE idempotency_keys (
  key TEXT PRIMARY KEY,
  job_id TEXT NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
  created_ms INTEGER NOT NULL
) STRICT, WITHOUT ROWID;
CREATE INDEX idempotency_keys_by_job ON idempotency_keys (job_id);
)";

constexpr const char* kColumns =
    "id, state, filename, parameters, input_sha256, input_bytes, progress, message, created_ms, "
    "started_ms, finished_ms, updated_ms, attempt, crash_count, failure_code, failure_kind, "
    "failure_message, timings";

/// Carries an Error out of nested statements; never leaves this file.
struct SqliteFailure {
  Error error;
};

[[noreturn]] void Throw(sqlite3* db, const char* doing) {
  const int code = sqlite3_errcode(db);
  const bool full = code == SQLITE_FULL || code == SQLITE_NOMEM;
  throw SqliteFailure{{full ? ErrorCode::kResourceExhausted : ErrorCode::kIo,
                       std::string("job store: ") + doing + ": " + sqlite3_errmsg(db),
                       full ? ErrorKind("no-space") : "job-store"}};
}

class Statement {
 public:
  Statement(sqlite3* db, const std::string& sql) : db_(db) {
    if (sqlite3_prepare_v2(db, sql.c_str(), -1, &statement_, nullptr) != SQLITE_OK) {
      Throw(db, "prepare");
    }
  }
  ~Statement() { sqlite3_finalize(statement_); }
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  Statement& Bind(const std::string& value) {
    return Checked(sqlite3_bind_text64(statement_, ++bound_, value.data(), value.size(),
                                       SQLITE_TRANSIENT, SQLITE_UTF8));
  }
  Statement& Bind(std::int64_t value) {
    return Checked(sqlite3_bind_int64(statement_, ++bound_, value));
  }
  Statement& Bind(const std::optional<std::string>& value) {
    return value ? Bind(*value) : Checked(sqlite3_bind_null(statement_, ++bound_));
  }

  /// Whether there is a row to read.
  bool Step() {
    const int code = sqlite3_step(statement_);
    if (code == SQLITE_ROW) return true;
    if (code == SQLITE_DONE) return false;
    Throw(db_, "step");
  }
  /// Rows changed.
  int Run() {
    while (Step()) {
    }
    return sqlite3_changes(db_);
  }
  [[nodiscard]] bool IsNull(int column) const {
    return sqlite3_column_type(statement_, column) == SQLITE_NULL;
  }
  [[nodiscard]] std::int64_t Integer(int column) const {
    return sqlite3_column_int64(statement_, column);
  }
  [[nodiscard]] std::string Text(int column) const {
    const unsigned char* text = sqlite3_column_text(statement_, column);
    const int size = sqlite3_column_bytes(statement_, column);
    return text == nullptr ? std::string() : std::string(text, text + size);
  }

 private:
  Statement& Checked(int code) {
    if (code != SQLITE_OK) Throw(db_, "bind");
    return *this;
  }

  sqlite3* db_;
  sqlite3_stmt* statement_ = nullptr;
  int bound_ = 0;
};

void Execute(sqlite3* db, const char* sql) {
  if (sqlite3_exec(db, sql, nullptr, nullptr, nullptr) != SQLITE_OK) Throw(db, "execute");
}

std::int64_t Pragma(sqlite3* db, const std::string& name) {
  Statement statement(db, "PRAGMA " + name);
  return statement.Step() ? statement.Integer(0) : 0;
}

/// Rolled back unless committed.
class Transaction {
 public:
  explicit Transaction(sqlite3* db) : db_(db) { Execute(db, "BEGIN IMMEDIATE"); }
  ~Transaction() {
    if (!committed_) sqlite3_exec(db_, "ROLLBACK", nullptr, nullptr, nullptr);
  }
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  void Commit() {
    Execute(db_, "COMMIT");
    committed_ = true;
  }

 private:
  sqlite3* db_;
  bool committed_ = false;
};

Job ReadJob(const Statement& row) {
  Job job;
  job.id = row.Text(0);
  job.state = JobStateOf(row.Text(1)).value_or(JobState::kFailed);
  job.filename = row.Text(2);
  job.parameters = DecodeQuery(row.Text(3)).value_or(Parameters{});
  job.input_sha256 = row.Text(4);
  job.input_bytes = row.Integer(5);
  job.progress = static_cast<int>(row.Integer(6));
  job.message = row.Text(7);
  job.created_ms = row.Integer(8);
  if (!row.IsNull(9)) job.started_ms = row.Integer(9);
  if (!row.IsNull(10)) job.finished_ms = row.Integer(10);
  job.updated_ms = row.Integer(11);
  job.attempt = row.Integer(12);
  job.crash_count = row.Integer(13);
  if (!row.IsNull(14)) {
    // Another version of the program may have written a kind or a code that this one does not know.
    job.failure = Error{ErrorCodeFromName(row.Text(14)).value_or(ErrorCode::kIo), row.Text(16),
                        ErrorKind::FromName(row.Text(15)).value_or(ErrorKind())};
  }
  const nlohmann::json timings = nlohmann::json::parse(row.Text(17), nullptr, false);
  for (const auto& [stage, seconds] : timings.items()) {
    if (seconds.is_number()) job.timings[stage] = seconds.get<double>();
  }
  return job;
}

class SqliteJobStore : public JobStore {
 public:
  ~SqliteJobStore() override { sqlite3_close(db_); }

  Status Open(const std::filesystem::path& path);

  Result<std::pair<Job, bool>> Insert(const NewJob& job, std::int64_t now_ms) override;
  Result<Job> Find(const std::string& id) override;
  Result<JobPage> List(const JobQuery& query) override;
  Result<std::int64_t> CountWaiting() override;
  Result<std::optional<Job>> ClaimNext(std::int64_t now_ms) override;
  Result<bool> ReportProgress(const std::string& id, std::int64_t attempt, int progress,
                              const std::string& message, std::int64_t now_ms) override;
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
  /// Runs `work` under the mutex and turns what SQLite says into an Error.
  template <typename Work>
  auto Guarded(Work work) -> decltype(work()) {
    const std::lock_guard lock(mutex_);
    try {
      return work();
    } catch (SqliteFailure& failure) {
      return std::move(failure.error);
    }
  }
  void Prepare();
  void Migrate();
  std::optional<Job> Select(const std::string& id) {
    Statement row(db_, std::string("SELECT ") + kColumns + " FROM jobs WHERE id = ?");
    row.Bind(id);
    if (!row.Step()) return std::nullopt;
    return ReadJob(row);
  }

  std::mutex mutex_;
  sqlite3* db_ = nullptr;
};

Error NoSuchJob() { return {ErrorCode::kNotFound, "there is no job with this id", "no-such-job"}; }

Error Unusable(const std::string& why, const std::string& remedy) {
  return {ErrorCode::kIo, "job store: " + why + "; " + remedy, "job-store-unusable"};
}

Status SqliteJobStore::Open(const std::filesystem::path& path) {
  return Guarded([&]() -> Status {
    const int flags = SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_FULLMUTEX;
    if (sqlite3_open_v2(path.c_str(), &db_, flags, nullptr) != SQLITE_OK) Throw(db_, "open");
    try {
      Prepare();
    } catch (SqliteFailure& failure) {
      return Unusable(failure.error.message,
                      "it may be damaged: restore it from a backup, or move the data directory "
                      "away to start afresh");
    }
    return Done{};
  });
}

void SqliteJobStore::Prepare() {
  const std::int64_t application = Pragma(db_, "application_id");
  const std::int64_t version = Pragma(db_, "user_version");
  const bool is_new = Pragma(db_, "page_count") == 0;
  if (!is_new && application != kApplicationId) {
    throw SqliteFailure{{ErrorCode::kIo, "the file is no job store of farhorizon"}};
  }
  if (version > kSchemaVersion) {
    throw SqliteFailure{{ErrorCode::kIo, "the file comes from a newer farhorizon (schema " +
                                             std::to_string(version) + ", this one knows " +
                                             std::to_string(kSchemaVersion) + ")"}};
  }
  Execute(db_,
          "PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL; PRAGMA foreign_keys = ON;"
          "PRAGMA trusted_schema = OFF; PRAGMA mmap_size = 0; PRAGMA busy_timeout = 2000;");
  // Drivers are known to change it: read back what durability hangs on.
  if (Pragma(db_, "synchronous") != 2) Throw(db_, "set synchronous=FULL");
  Migrate();
  Statement check(db_, "PRAGMA quick_check(1)");
  if (!check.Step() || check.Text(0) != "ok") {
    throw SqliteFailure{{ErrorCode::kIo, "quick_check says: " + check.Text(0)}};
  }
}

void SqliteJobStore::Migrate() {
  Transaction transaction(db_);
  if (Pragma(db_, "user_version") == 0) {
    Execute(db_, kSchema);
    Execute(db_, ("PRAGMA application_id = " + std::to_string(kApplicationId)).c_str());
    Execute(db_, ("PRAGMA user_version = " + std::to_string(kSchemaVersion)).c_str());
  }
  transaction.Commit();
}

Result<std::pair<Job, bool>> SqliteJobStore::Insert(const NewJob& job, std::int64_t now_ms) {
  return Guarded([&]() -> Result<std::pair<Job, bool>> {
    Transaction transaction(db_);
    const std::string parameters = EncodeQuery(job.parameters);
    if (job.idempotency_key) {
      Statement(db_, "DELETE FROM idempotency_keys WHERE created_ms < ?")
          .Bind(now_ms - kIdempotencyKeepMs)
          .Run();
      Statement known(db_, "SELECT job_id FROM idempotency_keys WHERE key = ?");
      if (known.Bind(*job.idempotency_key).Step()) {
        const std::optional<Job> earlier = Select(known.Text(0));
        if (earlier && earlier->input_sha256 == job.input_sha256 &&
            earlier->filename == job.filename && earlier->parameters == job.parameters) {
          return std::pair(*earlier, true);
        }
        return Error{ErrorCode::kInvalidArgument,
                     "this Idempotency-Key came with another DEM or other parameters before; "
                     "send a new key with a new job",
                     "idempotency-key-reused"};
      }
    }
    Statement insert(db_,
                     "INSERT INTO jobs (id, state, filename, parameters, input_sha256, "
                     "input_bytes, created_ms, updated_ms, message) "
                     "VALUES (?, 'accepted', ?, ?, ?, ?, ?, ?, 'waiting')");
    insert.Bind(job.id).Bind(job.filename).Bind(parameters).Bind(job.input_sha256);
    insert.Bind(job.input_bytes).Bind(now_ms).Bind(now_ms).Run();
    if (job.idempotency_key) {
      Statement key(db_, "INSERT INTO idempotency_keys (key, job_id, created_ms) VALUES (?, ?, ?)");
      key.Bind(*job.idempotency_key).Bind(job.id).Bind(now_ms).Run();
    }
    const std::optional<Job> stored = Select(job.id);
    Check(stored.has_value(), "an inserted job is there");
    transaction.Commit();
    return std::pair(*stored, false);
  });
}

Result<Job> SqliteJobStore::Find(const std::string& id) {
  return Guarded([&]() -> Result<Job> {
    std::optional<Job> job = Select(id);
    if (!job) return NoSuchJob();
    return *std::move(job);
  });
}

Result<JobPage> SqliteJobStore::List(const JobQuery& query) {
  return Guarded([&]() -> Result<JobPage> {
    std::string where = "WHERE 1";
    if (query.before) where += " AND id < ?";
    if (!query.states.empty()) {
      where += " AND state IN (?";
      for (std::size_t i = 1; i < query.states.size(); ++i) where += ", ?";
      where += ")";
    }
    Statement rows(db_, std::string("SELECT ") + kColumns + " FROM jobs " + where +
                            " ORDER BY id DESC LIMIT ?");
    if (query.before) rows.Bind(*query.before);
    for (const JobState state : query.states) rows.Bind(std::string(JobStateName(state)));
    rows.Bind(std::int64_t{query.limit} + 1);  // one more tells whether a page follows
    JobPage page;
    while (rows.Step()) page.jobs.push_back(ReadJob(rows));
    if (page.jobs.size() > static_cast<std::size_t>(query.limit)) {
      page.jobs.pop_back();
      page.next = page.jobs.back().id;
    }
    return page;
  });
}

Result<std::int64_t> SqliteJobStore::CountWaiting() {
  return Guarded([&]() -> Result<std::int64_t> {
    Statement count(db_, "SELECT count(*) FROM jobs WHERE state = 'accepted'");
    count.Step();
    return count.Integer(0);
  });
}

Result<std::optional<Job>> SqliteJobStore::ClaimNext(std::int64_t now_ms) {
  return Guarded([&]() -> Result<std::optional<Job>> {
    Statement claim(db_, std::string("UPDATE jobs SET state = 'running', attempt = attempt + 1, "
                                     "started_ms = coalesce(started_ms, ?), updated_ms = ?, "
                                     "message = 'starting' WHERE id = (SELECT id FROM jobs WHERE "
                                     "state = 'accepted' ORDER BY id LIMIT 1) RETURNING ") +
                             kColumns);
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
    Statement update(db_,
                     "UPDATE jobs SET progress = max(progress, ?), message = ?, updated_ms = ? "
                     "WHERE id = ? AND attempt = ? AND state = 'running'");
    update.Bind(std::int64_t{progress}).Bind(message).Bind(now_ms).Bind(id).Bind(attempt);
    return update.Run() == 1;
  });
}

Result<bool> SqliteJobStore::Publish(const std::string& id, std::int64_t attempt,
                                     const std::vector<Artifact>& artifacts,
                                     const std::map<std::string, double>& timings,
                                     std::int64_t now_ms) {
  return Guarded([&]() -> Result<bool> {
    Transaction transaction(db_);
    Statement update(db_,
                     "UPDATE jobs SET state = 'successful', progress = 100, message = 'done', "
                     "finished_ms = ?, updated_ms = ?, timings = ? "
                     "WHERE id = ? AND attempt = ? AND state = 'running'");
    update.Bind(now_ms).Bind(now_ms).Bind(nlohmann::json(timings).dump()).Bind(id).Bind(attempt);
    if (update.Run() != 1) return false;
    for (const Artifact& artifact : artifacts) {
      Statement insert(db_,
                       "INSERT INTO artifacts (job_id, name, media_type, bytes, sha256) "
                       "VALUES (?, ?, ?, ?, ?)");
      insert.Bind(id).Bind(artifact.name).Bind(artifact.media_type);
      insert.Bind(artifact.bytes).Bind(artifact.sha256).Run();
    }
    transaction.Commit();
    return true;
  });
}

Result<bool> SqliteJobStore::Fail(const std::string& id, std::int64_t attempt, const Error& failure,
                                  std::int64_t now_ms) {
  return Guarded([&]() -> Result<bool> {
    Statement update(db_,
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
    Statement update(db_,
                     "UPDATE jobs SET state = 'accepted', message = 'waiting to run again', "
                     "crash_count = crash_count + ?, updated_ms = ? "
                     "WHERE id = ? AND attempt = ? AND state = 'running'");
    update.Bind(std::int64_t{reason == RequeueReason::kWorkerCrashed ? 1 : 0}).Bind(now_ms);
    return update.Bind(id).Bind(attempt).Run() == 1;
  });
}

Result<Job> SqliteJobStore::Dismiss(const std::string& id, std::int64_t now_ms) {
  return Guarded([&]() -> Result<Job> {
    Transaction transaction(db_);
    std::optional<Job> job = Select(id);
    if (!job) return NoSuchJob();
    if (IsTerminal(job->state)) {
      Statement(db_, "DELETE FROM jobs WHERE id = ?").Bind(id).Run();
      job->state = JobState::kDismissed;
      job->failure.reset();
      job->message = "removed";
    } else {
      Statement update(db_,
                       "UPDATE jobs SET state = 'dismissed', message = 'dismissed', "
                       "finished_ms = ?, updated_ms = ? WHERE id = ?");
      update.Bind(now_ms).Bind(now_ms).Bind(id).Run();
      job = Select(id);
    }
    transaction.Commit();
    return *std::move(job);
  });
}

Result<std::int64_t> SqliteJobStore::RecoverRunning(std::int64_t now_ms) {
  return Guarded([&]() -> Result<std::int64_t> {
    Statement update(db_,
                     "UPDATE jobs SET state = 'accepted', message = 'waiting to run again', "
                     "updated_ms = ? WHERE state = 'running'");
    return std::int64_t{update.Bind(now_ms).Run()};
  });
}

Result<std::vector<Artifact>> SqliteJobStore::Artifacts(const std::string& id) {
  return Guarded([&]() -> Result<std::vector<Artifact>> {
    Statement rows(db_,
                   "SELECT name, media_type, bytes, sha256 FROM artifacts WHERE job_id = ? "
                   "ORDER BY name");
    rows.Bind(id);
    std::vector<Artifact> artifacts;
    while (rows.Step()) {
      artifacts.push_back({rows.Text(0), rows.Text(1), rows.Integer(2), rows.Text(3)});
    }
    return artifacts;
  });
}

Result<bool> SqliteJobStore::IsReferenced(const std::string& sha256) {
  return Guarded([&]() -> Result<bool> {
    Statement row(db_,
                  "SELECT 1 FROM jobs WHERE input_sha256 = ? UNION ALL "
                  "SELECT 1 FROM artifacts WHERE sha256 = ? LIMIT 1");
    return row.Bind(sha256).Bind(sha256).Step();
  });
}

Status SqliteJobStore::Ping() {
  return Guarded([&]() -> Status {
    Transaction transaction(db_);
    transaction.Commit();
    return Done{};
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

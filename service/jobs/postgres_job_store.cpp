// The shared job store: the statements are those of the embedded one (sql_queue.h, sql_claim.h,
// sql_runs.h, sql_removal.h, sql_rows.h) in PostgreSQL's dialect; here is what several processes
// need beside.
#include "service/jobs/postgres_job_store.h"

#include <algorithm>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "service/jobs/postgres.h"
#include "service/jobs/postgres_leases.h"
#include "service/jobs/postgres_listener.h"
#include "service/jobs/postgres_pins.h"
#include "service/jobs/postgres_pool.h"
#include "service/jobs/postgres_schema.h"
#include "service/jobs/sql_callbacks.h"
#include "service/jobs/sql_claim.h"
#include "service/jobs/sql_queue.h"
#include "service/jobs/sql_removal.h"
#include "service/jobs/sql_rows.h"
#include "service/jobs/sql_runs.h"

namespace farhorizon {

namespace {

using std::chrono::milliseconds;

constexpr PostgresTimes kTimesOfCalls{milliseconds(5000), milliseconds(3000)};
// A pin waits until objects are removed.
constexpr PostgresTimes kTimesOfPins{milliseconds(25'000), milliseconds(20'000)};
constexpr milliseconds kGrace{2000};  // for a network that is slow
// As StartTurns forgets clients in memory.
constexpr std::int64_t kTurnsKept = 10'000;

SqlDialect DialectOf(const PostgresStoreOptions& options) {
  SqlDialect dialect;
  dialect.greatest = "greatest";
  dialect.least = "least";
  dialect.lock_rows = " FOR UPDATE";
  dialect.lock_free = " FOR UPDATE SKIP LOCKED";
  dialect.lock_queue = "SELECT pg_advisory_xact_lock(1179142741)";
  dialect.own_runs = "holder = '" + options.holder + "'";
  dialect.claim = ", holder = '" + options.holder + "', lease_until = clock_timestamp() + " +
                  std::to_string(options.lease.count()) + " * interval '1 millisecond'";
  dialect.turn_of = "coalesce((SELECT turn FROM turns WHERE turns.client = waiting.client), 0)";
  dialect.serve_client =
      "INSERT INTO turns (client, turn) VALUES (?, nextval('turn')) "
      "ON CONFLICT (client) DO UPDATE SET turn = excluded.turn";
  dialect.clock_ms = "CAST(extract(epoch FROM clock_timestamp()) * 1000 AS BIGINT)";
  return dialect;
}

class PostgresJobStore : public JobStore {
 public:
  explicit PostgresJobStore(PostgresStoreOptions options);
  Status Open();

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

  [[nodiscard]] std::optional<milliseconds> LeaseTime() const override { return options_.lease; }
  Result<std::vector<std::string>> Hold(const std::vector<HeldRun>& runs) override;
  Result<std::int64_t> RecoverLost(std::int64_t now_ms) override;
  void Listen(std::function<void(StoreNews)> handler) override;
  Result<std::unique_ptr<ObjectLock>> PinObjects() override;
  Result<std::unique_ptr<ObjectLock>> HaltPins(bool wait) override;

 private:
  // Runs work(connection): over that of this thread's pin, or one of the pool. Returns a SqlFailure
  // as its Error.
  template <typename Work>
  auto Guarded(Work work) -> decltype(work(std::declval<PostgresDatabase&>())) {
    try {
      if (PostgresPool::Loan* pin = pins_.OfThread()) return pin->Run(work);
      return calls_.Run(work);
    } catch (SqlFailure& failure) {
      return std::move(failure.error);
    }
  }
  // The same for work that has no Error of its own to return.
  template <typename Work>
  auto Call(Work work) -> Result<decltype(work(std::declval<PostgresDatabase&>()))> {
    return Guarded([&](PostgresDatabase& database)
                       -> Result<decltype(work(std::declval<PostgresDatabase&>()))> {
      return work(database);
    });
  }
  // The same for one statement that writes, in a transaction: what is lost before its commit was
  // not done.
  template <typename Work>
  auto Write(Work work) -> Result<decltype(work(std::declval<PostgresDatabase&>()))> {
    return Call([&](PostgresDatabase& database) {
      Transaction transaction(database);
      auto result = work(database);
      transaction.Commit();
      return result;
    });
  }
  // The time for a row that is written now: never before one that the store had when this was
  // called.
  static std::int64_t Later(const SqlDatabase& database, std::int64_t now_ms) {
    Statement latest(database, "SELECT max(updated_ms) FROM jobs");
    return latest.Step() ? std::max(now_ms, latest.Integer(0)) : now_ms;
  }

  const PostgresStoreOptions options_;
  const SqlDialect dialect_;
  PostgresPool calls_;
  PostgresPins pins_;
  std::mutex claims_;  // of this process follow one another: turns_ is theirs
  StartTurns turns_;
  std::unique_ptr<PostgresListener> news_;
};

PostgresPool::Connect ConnectTo(const PostgresStoreOptions& options, const PostgresTimes& times) {
  return [url = options.url, times, dialect = DialectOf(options)] {
    return std::make_unique<PostgresDatabase>(url, times, dialect);
  };
}

PostgresJobStore::PostgresJobStore(PostgresStoreOptions options)
    : options_(std::move(options)),
      dialect_(DialectOf(options_)),
      calls_(ConnectTo(options_, kTimesOfCalls), options_.connections,
             kTimesOfCalls.statement + kGrace),
      pins_(ConnectTo(options_, kTimesOfPins), options_.connections,
            kTimesOfPins.statement + kGrace) {}

Status PostgresJobStore::Open() {
  try {
    // Without a bound: a migration of many rows takes its time.
    PostgresDatabase database(options_.url, kTimesOfCalls, dialect_);
    PreparePostgresSchema(database);
    return Ok{};
  } catch (SqlFailure& failure) {
    if (failure.error.kind == "job-store-unusable") return std::move(failure.error);
    return Error{ErrorCode::kIo,
                 "job store: " + (failure.cause.empty() ? failure.error.message : failure.cause) +
                     " (store.jobs); see that the server runs, and that the user may connect and "
                     "make the schema farhorizon",
                 "job-store-unusable"};
  }
}

Result<Job> PostgresJobStore::Insert(const NewJob& job, const QueueBounds& bounds,
                                     std::int64_t now_ms) {
  return Guarded([&](PostgresDatabase& database) -> Result<Job> {
    Transaction transaction(database);
    Statement(database, dialect_.lock_queue).Run();
    Result<Job> stored = InsertInQueue(database, job, bounds, Later(database, now_ms));
    if (!stored) return stored;
    Tell(database, kNewsJobWaits);
    transaction.Commit();
    return stored;
  });
}

Result<std::optional<Job>> PostgresJobStore::FindEarlier(const NewJob& job, std::int64_t now_ms) {
  return Guarded([&](PostgresDatabase& database) -> Result<std::optional<Job>> {
    return FindEarlierJob(database, job, now_ms);
  });
}

Status PostgresJobStore::CheckQueue(const std::string& client, const QueueBounds& bounds) {
  return Guarded([&](PostgresDatabase& database) -> Status {
    return farhorizon::CheckQueue(database, client, bounds);
  });
}

Result<Job> PostgresJobStore::Find(const std::string& id) {
  return Guarded([&](PostgresDatabase& database) -> Result<Job> {
    std::optional<Job> job = SelectJob(database, id);
    if (!job) return NoSuchJob();
    return *std::move(job);
  });
}

Result<JobPage> PostgresJobStore::List(const JobQuery& query) {
  return Call([&](PostgresDatabase& database) { return SelectPage(database, query); });
}

Result<UnfinishedJobs> PostgresJobStore::CountUnfinished() {
  return Call([](PostgresDatabase& database) { return CountUnfinishedJobs(database); });
}

Result<std::optional<Job>> PostgresJobStore::ClaimNext(std::int64_t now_ms,
                                                       const MemoryRoom& room) {
  const std::lock_guard lock(claims_);
  return Call([&](PostgresDatabase& database) {
    return ClaimJob(database, turns_, room, Later(database, now_ms));
  });
}

Result<std::vector<std::string>> PostgresJobStore::FailOverdue(std::int64_t now_ms) {
  return Call([&](PostgresDatabase& database) {
    return FailOverdueJobs(database, Later(database, now_ms));
  });
}

Result<bool> PostgresJobStore::ReportProgress(const std::string& id, std::int64_t run, int progress,
                                              const std::string& message, std::int64_t now_ms) {
  return Write([&](PostgresDatabase& database) {
    return StoreProgress(database, {id, run, Later(database, now_ms)}, progress, message);
  });
}

Result<bool> PostgresJobStore::ReportAssumptions(const std::string& id, std::int64_t run,
                                                 const Assumptions& assumptions,
                                                 std::int64_t now_ms) {
  return Write([&](PostgresDatabase& database) {
    return StoreAssumptions(database, {id, run, Later(database, now_ms)}, assumptions);
  });
}

Result<bool> PostgresJobStore::Publish(const std::string& id, std::int64_t run,
                                       const std::vector<Artifact>& artifacts,
                                       const std::map<std::string, double>& timings,
                                       std::int64_t now_ms) {
  return Call([&](PostgresDatabase& database) {
    return PublishRun(database, {id, run, Later(database, now_ms)}, artifacts, timings);
  });
}

Result<bool> PostgresJobStore::Fail(const std::string& id, std::int64_t run, const Error& failure,
                                    std::int64_t now_ms) {
  return Write([&](PostgresDatabase& database) {
    return FailRun(database, {id, run, Later(database, now_ms)}, failure);
  });
}

Result<bool> PostgresJobStore::Requeue(const std::string& id, std::int64_t run,
                                       RequeueReason reason, std::int64_t now_ms) {
  return Write([&](PostgresDatabase& database) {
    Tell(database, kNewsJobWaits);
    return RequeueRun(database, {id, run, Later(database, now_ms)}, reason);
  });
}

Result<bool> PostgresJobStore::RequeueWithMemory(const std::string& id, std::int64_t run,
                                                 std::int64_t memory_bytes, std::int64_t now_ms) {
  return Write([&](PostgresDatabase& database) {
    return farhorizon::RequeueWithMemory(database, {id, run, Later(database, now_ms)},
                                         memory_bytes);
  });
}

Result<bool> PostgresJobStore::Postpone(const std::string& id, std::int64_t run,
                                        std::int64_t delay_ms, std::int64_t now_ms) {
  return Write([&](PostgresDatabase& database) {
    return PostponeRun(database, {id, run, Later(database, now_ms)}, delay_ms);
  });
}

Result<Job> PostgresJobStore::Dismiss(const std::string& id, std::int64_t now_ms) {
  Result<Job> dismissed = Guarded([&](PostgresDatabase& database) -> Result<Job> {
    return DismissJob(database, id, Later(database, now_ms));
  });
  if (!dismissed) return dismissed;
  // What is not heard of here is heard of when the lease is next renewed.
  [[maybe_unused]] const Result<bool> told = Call([](PostgresDatabase& database) {
    Tell(database, kNewsRunEnded);
    return true;
  });
  return dismissed;
}

Result<std::int64_t> PostgresJobStore::RemoveExpired(const Retention& retention,
                                                     std::int64_t now_ms) {
  return Call([&](PostgresDatabase& database) {
    Statement(database, "DELETE FROM turns WHERE turn < (SELECT last_value FROM turn) - ?")
        .Bind(kTurnsKept)
        .Run();
    return RemoveExpiredJobs(database, retention, now_ms);
  });
}

Result<std::int64_t> PostgresJobStore::RecoverRunning(PreviousEnd end, std::int64_t now_ms) {
  return Call([&](PostgresDatabase& database) {
    return RecoverJobs(database, end, Later(database, now_ms));
  });
}

Result<std::optional<DueCallback>> PostgresJobStore::ClaimCallback(milliseconds lease,
                                                                   std::int64_t now_ms) {
  return Call([&](PostgresDatabase& database) {
    return farhorizon::ClaimCallback(database, lease, now_ms);
  });
}

Result<bool> PostgresJobStore::EndCallback(const DueCallback& callback, CallbackEnd end) {
  return Write(
      [&](PostgresDatabase& database) { return farhorizon::EndCallback(database, callback, end); });
}

Result<bool> PostgresJobStore::RetryCallback(const DueCallback& callback, milliseconds delay,
                                             std::int64_t now_ms) {
  return Write([&](PostgresDatabase& database) {
    return farhorizon::RetryCallback(database, callback, delay, now_ms);
  });
}

Result<std::vector<Artifact>> PostgresJobStore::Artifacts(const std::string& id) {
  return Call([&](PostgresDatabase& database) { return SelectArtifacts(database, id); });
}

Result<bool> PostgresJobStore::IsReferenced(const std::string& sha256) {
  return Call(
      [&](PostgresDatabase& database) { return farhorizon::IsReferenced(database, sha256); });
}

Result<std::vector<std::string>> PostgresJobStore::Garbage() {
  return Call([](PostgresDatabase& database) { return SelectGarbage(database); });
}

Status PostgresJobStore::ForgetGarbage(const std::vector<std::string>& names) {
  return Guarded([&](PostgresDatabase& database) -> Status {
    farhorizon::ForgetGarbage(database, names);
    return Ok{};
  });
}

Result<StoreIdentity> PostgresJobStore::Identity() {
  return Call([](PostgresDatabase& database) { return SelectIdentity(database); });
}

Result<StoreIdentity> PostgresJobStore::BeginGeneration() {
  return Write([](PostgresDatabase& database) {
    Statement(database, "UPDATE store SET generation = generation + 1").Run();
    return SelectIdentity(database);
  });
}

Status PostgresJobStore::Ping() {
  return Guarded([](PostgresDatabase& database) -> Status {
    // Somebody may have locked the one that every request needs.
    Statement(database, "SELECT 1 FROM jobs LIMIT 1").Step();
    Statement(database, "UPDATE store SET pings = pings + 1").Run();
    return Ok{};
  });
}

Status PostgresJobStore::Transact(const std::function<Status(SqlDatabase&)>& work) {
  return Guarded([&](PostgresDatabase& database) -> Status {
    Transaction transaction(database);
    Status done = work(database);
    if (done) transaction.Commit();
    return done;
  });
}

Result<std::vector<std::string>> PostgresJobStore::Hold(const std::vector<HeldRun>& runs) {
  return Write([&](PostgresDatabase& database) { return HoldRuns(database, runs); });
}

Result<std::int64_t> PostgresJobStore::RecoverLost(std::int64_t now_ms) {
  return Call([&](PostgresDatabase& database) {
    return RecoverLostJobs(database, Later(database, now_ms));
  });
}

void PostgresJobStore::Listen(std::function<void(StoreNews)> handler) {
  news_.reset();
  if (!handler) return;
  news_ = std::make_unique<PostgresListener>(ConnectTo(options_, kTimesOfCalls), std::move(handler),
                                             [this](const std::string& id) { Changed(id); });
}

Result<std::unique_ptr<ObjectLock>> PostgresJobStore::PinObjects() { return pins_.Pin(); }

Result<std::unique_ptr<ObjectLock>> PostgresJobStore::HaltPins(bool wait) {
  return pins_.Halt(wait);
}

}  // namespace

Result<std::unique_ptr<JobStore>> OpenPostgresJobStore(const PostgresStoreOptions& options) {
  auto store = std::make_unique<PostgresJobStore>(options);
  Status opened = store->Open();
  if (!opened) return std::move(opened.error());
  return std::unique_ptr<JobStore>(std::move(store));
}

}  // namespace farhorizon

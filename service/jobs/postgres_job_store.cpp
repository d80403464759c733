// The shared job store: SqlJobStore in PostgreSQL's dialect; here is what several processes need
// beside. Changes are told by a trigger of the tables (postgres_schema.cpp), to this process too.
#include "service/jobs/postgres_job_store.h"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "service/jobs/postgres.h"
#include "service/jobs/postgres_leases.h"
#include "service/jobs/postgres_listener.h"
#include "service/jobs/postgres_pins.h"
#include "service/jobs/postgres_pool.h"
#include "service/jobs/postgres_schema.h"
#include "service/jobs/sql_job_store.h"
#include "service/jobs/sql_rows.h"

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

class PostgresJobStore : public SqlJobStore {
 public:
  explicit PostgresJobStore(PostgresStoreOptions options);
  Status Open();

  Result<std::int64_t> RemoveExpired(const Retention& retention, std::int64_t now_ms) override;
  Result<StoreIdentity> BeginGeneration() override;
  Status Ping() override;

  [[nodiscard]] std::optional<milliseconds> LeaseTime() const override { return options_.lease; }
  Result<std::vector<std::string>> Hold(const std::vector<HeldRun>& runs) override;
  Result<std::int64_t> RecoverLost(std::int64_t now_ms) override;
  void Listen(std::function<void(StoreNews)> handler) override;
  Result<std::unique_ptr<ObjectLock>> PinObjects() override;
  Result<std::unique_ptr<ObjectLock>> HaltPins(bool wait) override;

 private:
  Status RunRead(const Reading& work) override { return RunCall(work); }
  Status RunCall(const Writing& work) override;
  // In a transaction: what is lost before its commit was not done.
  Status RunWrite(const Writing& work) override;
  std::int64_t Later(const SqlDatabase& database, std::int64_t now_ms) override;
  void Tell(const SqlDatabase& database, StoreNews news) override;

  const PostgresStoreOptions options_;
  const SqlDialect dialect_;
  PostgresPool calls_;
  PostgresPins pins_;
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

// Over the connection of this thread's pin, or one of the pool.
Status PostgresJobStore::RunCall(const Writing& work) {
  const auto run = [&work](PostgresDatabase& database) -> Status {
    work(database);
    return Ok{};
  };
  try {
    if (PostgresPool::Loan* pin = pins_.OfThread()) return pin->Run(run);
    return calls_.Run(run);
  } catch (SqlFailure& failure) {
    return std::move(failure.error);
  }
}

Status PostgresJobStore::RunWrite(const Writing& work) {
  return RunCall([&work](SqlDatabase& database) {
    Transaction transaction(database);
    work(database);
    transaction.Commit();
  });
}

std::int64_t PostgresJobStore::Later(const SqlDatabase& database, std::int64_t now_ms) {
  Statement latest(database, "SELECT max(updated_ms) FROM jobs");
  return latest.Step() ? std::max(now_ms, latest.Integer(0)) : now_ms;
}

void PostgresJobStore::Tell(const SqlDatabase& database, StoreNews news) {
  farhorizon::Tell(database, news == StoreNews::kJobWaits ? kNewsJobWaits : kNewsRunEnded);
}

Result<std::int64_t> PostgresJobStore::RemoveExpired(const Retention& retention,
                                                     std::int64_t now_ms) {
  const Status forgotten = Call([](const SqlDatabase& database) {
    Statement(database, "DELETE FROM turns WHERE turn < (SELECT last_value FROM turn) - ?")
        .Bind(kTurnsKept)
        .Run();
    return Ok{};
  });
  if (!forgotten) return forgotten.error();
  return SqlJobStore::RemoveExpired(retention, now_ms);
}

Result<StoreIdentity> PostgresJobStore::BeginGeneration() {
  return Write([](const SqlDatabase& database) {
    Statement(database, "UPDATE store SET generation = generation + 1").Run();
    return SelectIdentity(database);
  });
}

Status PostgresJobStore::Ping() {
  return Call([](const SqlDatabase& database) {
    // Somebody may have locked the one that every request needs.
    Statement(database, "SELECT 1 FROM jobs LIMIT 1").Step();
    Statement(database, "UPDATE store SET pings = pings + 1").Run();
    return Ok{};
  });
}

Result<std::vector<std::string>> PostgresJobStore::Hold(const std::vector<HeldRun>& runs) {
  return Write([&](SqlDatabase& database) { return HoldRuns(database, runs); });
}

Result<std::int64_t> PostgresJobStore::RecoverLost(std::int64_t now_ms) {
  return Call(
      [&](SqlDatabase& database) { return RecoverLostJobs(database, Later(database, now_ms)); });
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

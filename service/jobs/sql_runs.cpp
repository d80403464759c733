#include "service/jobs/sql_runs.h"

#include <nlohmann/json.hpp>

#include "service/jobs/sql_rows.h"

namespace farhorizon {

namespace {

constexpr const char* kOfThisRun =
    ", updated_ms = ? WHERE id = ? AND run = ? AND state = 'running'";

std::string Setting(const std::string& changes) {
  return "UPDATE jobs SET " + changes + kOfThisRun;
}

// Binds what kOfThisRun asks for and runs the statement.
bool Change(Statement& update, const RunAt& at) {
  return update.Bind(at.now_ms).Bind(at.id).Bind(at.run).Run() == 1;
}

}  // namespace

bool StoreProgress(const SqlDatabase& database, const RunAt& at, int progress,
                   const std::string& message) {
  const std::string changes =
      "progress = " + database.dialect().greatest + "(progress, ?), message = ?";
  Statement update(database, Setting(changes));
  update.Bind(std::int64_t{progress}).Bind(message);
  return Change(update, at);
}

bool StoreAssumptions(const SqlDatabase& database, const RunAt& at,
                      const Assumptions& assumptions) {
  Statement update(database, Setting("assumptions = ?"));
  update.Bind(AssumptionsColumn(assumptions));
  return Change(update, at);
}

bool PublishRun(SqlDatabase& database, const RunAt& at, const std::vector<Artifact>& artifacts,
                const std::map<std::string, double>& timings) {
  Transaction transaction(database);
  Statement update(database, Setting("state = 'successful', progress = 100, message = 'done', "
                                     "finished_ms = ?, timings = ?"));
  update.Bind(at.now_ms).Bind(nlohmann::json(timings).dump());
  if (!Change(update, at)) return false;
  for (const Artifact& artifact : artifacts) InsertArtifact(database, at.id, artifact);
  transaction.Commit();
  return true;
}

bool FailRun(const SqlDatabase& database, const RunAt& at, const Error& failure) {
  Statement update(database, Setting(kSetFailed));
  BindFailure(update, failure, at.now_ms);
  return Change(update, at);
}

bool RequeueRun(const SqlDatabase& database, const RunAt& at, RequeueReason reason) {
  const std::int64_t crashed = reason == RequeueReason::kWorkerCrashed ? 1 : 0;
  Statement update(database, Setting("state = 'accepted', message = 'waiting to run again', "
                                     "crash_count = crash_count + ?, attempt = attempt - ?"));
  update.Bind(crashed).Bind(1 - crashed);
  return Change(update, at);
}

bool RequeueWithMemory(const SqlDatabase& database, const RunAt& at, std::int64_t memory_bytes) {
  Statement update(database, Setting("state = 'accepted', cost_memory_bytes = ?, "
                                     "message = 'waiting to run again'"));
  update.Bind(memory_bytes);
  return Change(update, at);
}

bool PostponeRun(const SqlDatabase& database, const RunAt& at, std::int64_t delay_ms) {
  Statement update(database,
                   Setting("state = 'accepted', message = 'waiting to run again', "
                           "retries = retries + 1, attempt = attempt - 1, not_before_ms = ?"));
  update.Bind(at.now_ms + delay_ms);
  return Change(update, at);
}

}  // namespace farhorizon

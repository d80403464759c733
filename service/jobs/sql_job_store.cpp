#include "service/jobs/sql_job_store.h"

#include "service/jobs/sql_callbacks.h"
#include "service/jobs/sql_queue.h"
#include "service/jobs/sql_removal.h"
#include "service/jobs/sql_rows.h"
#include "service/jobs/sql_runs.h"

namespace farhorizon {

Result<Job> SqlJobStore::Insert(const NewJob& job, const QueueBounds& bounds, std::int64_t now_ms) {
  return Call([&](SqlDatabase& database) -> Result<Job> {
    Transaction transaction(database);
    LockQueue(database);
    Result<Job> stored = InsertInQueue(database, job, bounds, Later(database, now_ms));
    if (!stored) return stored;
    Tell(database, StoreNews::kJobWaits);
    transaction.Commit();
    return stored;
  });
}

Result<std::optional<Job>> SqlJobStore::FindEarlier(const NewJob& job, std::int64_t now_ms) {
  return Read([&](const SqlDatabase& database) { return FindEarlierJob(database, job, now_ms); });
}

Status SqlJobStore::CheckQueue(const std::string& client, const QueueBounds& bounds) {
  return Read([&](const SqlDatabase& database) {
    return farhorizon::CheckQueue(database, client, bounds);
  });
}

Result<Job> SqlJobStore::Find(const std::string& id) {
  return Read([&](const SqlDatabase& database) -> Result<Job> {
    std::optional<Job> job = SelectJob(database, id);
    if (!job) return NoSuchJob();
    return *std::move(job);
  });
}

Result<JobPage> SqlJobStore::List(const JobQuery& query) {
  return Read([&](const SqlDatabase& database) { return SelectPage(database, query); });
}

Result<UnfinishedJobs> SqlJobStore::CountUnfinished() {
  return Read([](const SqlDatabase& database) { return CountUnfinishedJobs(database); });
}

Result<std::optional<Job>> SqlJobStore::ClaimNext(std::int64_t now_ms, const MemoryRoom& room) {
  const std::lock_guard lock(claims_);
  Result<std::optional<Job>> job = Call([&](SqlDatabase& database) {
    return ClaimJob(database, turns_, room, Later(database, now_ms));
  });
  if (job && *job) ChangedHere((*job)->id);
  return job;
}

Result<std::vector<std::string>> SqlJobStore::FailOverdue(std::int64_t now_ms) {
  Result<std::vector<std::string>> failed = Call(
      [&](SqlDatabase& database) { return FailOverdueJobs(database, Later(database, now_ms)); });
  if (!failed) return failed;
  for (const std::string& id : *failed) ChangedHere(id);
  return failed;
}

Result<bool> SqlJobStore::ReportProgress(const std::string& id, std::int64_t run, int progress,
                                         const std::string& message, std::int64_t now_ms) {
  return Change(id, [&](SqlDatabase& database) {
    return StoreProgress(database, {id, run, Later(database, now_ms)}, progress, message);
  });
}

Result<bool> SqlJobStore::ReportAssumptions(const std::string& id, std::int64_t run,
                                            const Assumptions& assumptions, std::int64_t now_ms) {
  return Change(id, [&](SqlDatabase& database) {
    return StoreAssumptions(database, {id, run, Later(database, now_ms)}, assumptions);
  });
}

Result<bool> SqlJobStore::Publish(const std::string& id, std::int64_t run,
                                  const std::vector<Artifact>& artifacts,
                                  const std::map<std::string, double>& timings,
                                  std::int64_t now_ms) {
  const Result<bool> published = Call([&](SqlDatabase& database) {
    return PublishRun(database, {id, run, Later(database, now_ms)}, artifacts, timings);
  });
  if (published && *published) ChangedHere(id);
  return published;
}

Result<bool> SqlJobStore::Fail(const std::string& id, std::int64_t run, const Error& failure,
                               std::int64_t now_ms) {
  return Change(id, [&](SqlDatabase& database) {
    return FailRun(database, {id, run, Later(database, now_ms)}, failure);
  });
}

Result<bool> SqlJobStore::Requeue(const std::string& id, std::int64_t run, RequeueReason reason,
                                  std::int64_t now_ms) {
  return Change(id, [&](SqlDatabase& database) {
    Tell(database, StoreNews::kJobWaits);
    return RequeueRun(database, {id, run, Later(database, now_ms)}, reason);
  });
}

Result<bool> SqlJobStore::RequeueWithMemory(const std::string& id, std::int64_t run,
                                            std::int64_t memory_bytes, std::int64_t now_ms) {
  return Change(id, [&](SqlDatabase& database) {
    return farhorizon::RequeueWithMemory(database, {id, run, Later(database, now_ms)},
                                         memory_bytes);
  });
}

Result<bool> SqlJobStore::Postpone(const std::string& id, std::int64_t run, std::int64_t delay_ms,
                                   std::int64_t now_ms) {
  return Change(id, [&](SqlDatabase& database) {
    return PostponeRun(database, {id, run, Later(database, now_ms)}, delay_ms);
  });
}

Result<Job> SqlJobStore::Dismiss(const std::string& id, std::int64_t now_ms) {
  Result<Job> dismissed = Call(
      [&](SqlDatabase& database) { return DismissJob(database, id, Later(database, now_ms)); });
  if (!dismissed) return dismissed;
  ChangedHere(id);
  // What another process does not hear of now it hears of when its lease is next renewed.
  (void)Call([this](SqlDatabase& database) {
    Tell(database, StoreNews::kRunEnded);
    return true;
  });
  return dismissed;
}

Result<std::int64_t> SqlJobStore::RemoveExpired(const Retention& retention, std::int64_t now_ms) {
  return Changing(
      Call([&](SqlDatabase& database) { return RemoveExpiredJobs(database, retention, now_ms); }));
}

Result<std::int64_t> SqlJobStore::RecoverRunning(PreviousEnd end, std::int64_t now_ms) {
  return Changing(Call(
      [&](SqlDatabase& database) { return RecoverJobs(database, end, Later(database, now_ms)); }));
}

Result<std::optional<DueCallback>> SqlJobStore::ClaimCallback(std::chrono::milliseconds lease,
                                                              std::int64_t now_ms) {
  return Call(
      [&](SqlDatabase& database) { return farhorizon::ClaimCallback(database, lease, now_ms); });
}

Result<bool> SqlJobStore::EndCallback(const DueCallback& callback, CallbackEnd end) {
  return Write(
      [&](SqlDatabase& database) { return farhorizon::EndCallback(database, callback, end); });
}

Result<bool> SqlJobStore::RetryCallback(const DueCallback& callback,
                                        std::chrono::milliseconds delay, std::int64_t now_ms) {
  return Write([&](SqlDatabase& database) {
    return farhorizon::RetryCallback(database, callback, delay, now_ms);
  });
}

Result<std::vector<Artifact>> SqlJobStore::Artifacts(const std::string& id) {
  return Read([&](const SqlDatabase& database) { return SelectArtifacts(database, id); });
}

Result<bool> SqlJobStore::IsReferenced(const std::string& sha256) {
  return Call(
      [&](const SqlDatabase& database) { return farhorizon::IsReferenced(database, sha256); });
}

Result<std::vector<std::string>> SqlJobStore::Garbage() {
  return Call([](const SqlDatabase& database) { return SelectGarbage(database); });
}

Status SqlJobStore::ForgetGarbage(const std::vector<std::string>& names) {
  return Call([&](SqlDatabase& database) {
    farhorizon::ForgetGarbage(database, names);
    return Ok{};
  });
}

Result<StoreIdentity> SqlJobStore::Identity() {
  return Call([](const SqlDatabase& database) { return SelectIdentity(database); });
}

Status SqlJobStore::Transact(const std::function<Status(SqlDatabase&)>& work) {
  return Call([&](SqlDatabase& database) -> Status {
    Transaction transaction(database);
    Status done = work(database);
    if (done) transaction.Commit();
    return done;
  });
}

}  // namespace farhorizon

#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "service/jobs/job_store.h"
#include "service/jobs/sql.h"
#include "service/jobs/sql_claim.h"

namespace farhorizon {

/// The calls of JobStore in SQL: each is a statement or a transaction of sql_queue.h, sql_claim.h,
/// sql_runs.h, sql_removal.h, sql_callbacks.h or sql_rows.h. An engine says how a call gets its
/// connection, which time it writes, and whom it tells.
class SqlJobStore : public JobStore {
 public:
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
  Status Transact(const std::function<Status(SqlDatabase&)>& work) override;

 protected:
  using Reading = std::function<void(const SqlDatabase&)>;
  using Writing = std::function<void(SqlDatabase&)>;

  // Each runs `work` on a connection, again after a try that stored nothing, and returns a
  // SqlFailure as its Error.

  /// For what a client waits for.
  virtual Status RunRead(const Reading& work) = 0;
  /// For work that reads, or has a transaction of its own.
  virtual Status RunCall(const Writing& work) = 0;
  /// For one statement that writes, or some that belong together.
  virtual Status RunWrite(const Writing& work) = 0;

  /// The time for a row that is written now, by the connection of a call: never before one that
  /// the store had when it was called.
  virtual std::int64_t Later(const SqlDatabase& database, std::int64_t now_ms) = 0;
  /// Tells the news to other processes, once the transaction is committed.
  virtual void Tell(const SqlDatabase& /*database*/, StoreNews /*news*/) {}
  /// A call of this process has changed the job, or, where `id` is empty, any.
  virtual void ChangedHere(const std::string& /*id*/) {}

  // What `work` returns, a value or a Result, or the Error of a SqlFailure.
  template <typename Work>
  auto Read(Work work) {
    return In<const SqlDatabase>(&SqlJobStore::RunRead, std::move(work));
  }
  template <typename Work>
  auto Call(Work work) {
    return In<SqlDatabase>(&SqlJobStore::RunCall, std::move(work));
  }
  template <typename Work>
  auto Write(Work work) {
    return In<SqlDatabase>(&SqlJobStore::RunWrite, std::move(work));
  }

 private:
  template <typename Value>
  struct AsResult {
    using Type = Result<Value>;
  };
  template <typename Value>
  struct AsResult<Result<Value>> {
    using Type = Result<Value>;
  };

  template <typename Database, typename Work>
  auto In(Status (SqlJobStore::*run)(const std::function<void(Database&)>&), Work work) ->
      typename AsResult<decltype(work(std::declval<Database&>()))>::Type {
    std::optional<typename AsResult<decltype(work(std::declval<Database&>()))>::Type> answer;
    Status ran = (this->*run)([&](Database& database) { answer.emplace(work(database)); });
    if (!ran) return std::move(ran.error());
    return *std::move(answer);
  }
  // A write that has changed the job, if it returns true.
  template <typename Work>
  Result<bool> Change(const std::string& id, Work work) {
    Result<bool> changed = Write(std::move(work));
    if (changed && *changed) ChangedHere(id);
    return changed;
  }
  // What has changed as many jobs as it says.
  Result<std::int64_t> Changing(Result<std::int64_t> changed) {
    if (changed && *changed > 0) ChangedHere("");
    return changed;
  }

  std::mutex claims_;  // of this process follow one another: turns_ is theirs
  StartTurns turns_;
};

}  // namespace farhorizon

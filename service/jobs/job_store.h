#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <shared_mutex>
#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "service/jobs/callback.h"
#include "service/jobs/job.h"

namespace farhorizon {

class SqlDatabase;

/// A job as it is submitted; Insert makes an accepted job of it.
struct NewJob {
  std::string filename;
  Parameters parameters;
  std::string input_sha256;
  std::int64_t input_bytes = 0;
  std::optional<std::string> idempotency_key;
  Assumptions assumptions = {};  ///< as far as they are known before it runs
  std::string client = {};       ///< whose turn it takes
  JobTerms terms = {};
  JobCost cost = {};
  std::string process = kTerrainProcess;
  std::string answer = {};  ///< as Job has it
  std::string owner = {};   ///< whose key it comes with; empty: no key was asked for
  /// The SHA-256 of the link that the input was fetched by; empty: it was sent.
  std::string source = {};
  Subscriber subscriber = {};
};

/// How many jobs have not ended.
struct UnfinishedJobs {
  std::int64_t accepted = 0;
  std::int64_t running = 0;
};

/// How many jobs may wait.
struct QueueBounds {
  std::int64_t all = 1000;
  std::int64_t of_client = 1000;
};

/// Memory for the next job.
struct MemoryRoom {
  std::int64_t free_bytes = std::numeric_limits<std::int64_t>::max();
  /// As much as one job may have: what counts for a job that needs more, or no one knows how much.
  std::int64_t most_bytes = std::numeric_limits<std::int64_t>::max();
};

/// The jobs that a page of the list is to have.
struct JobQuery {
  std::vector<JobState> states = {};       ///< empty: all
  std::optional<std::string> before = {};  ///< only jobs with a lesser id: the page's cursor
  int limit = 10;
  std::vector<std::string> processes = {};  ///< empty: all
  /// When the jobs were accepted, both ends included.
  std::optional<std::int64_t> created_from_ms = {};
  std::optional<std::int64_t> created_to_ms = {};
  /// How long the jobs took, those that run until now_ms. Where one of the two is set, jobs that
  /// wait or have never started are left out.
  std::optional<std::int64_t> least_duration_ms = {};
  std::optional<std::int64_t> most_duration_ms = {};
  std::int64_t now_ms = 0;
  std::optional<std::string> owner = {};  ///< only jobs of this owner, who is not empty
};

/// Newest first. next: the cursor of the following page, unset on the last.
struct JobPage {
  std::vector<Job> jobs;
  std::optional<std::string> next;
};

/// How long finished jobs are kept; 0: without end.
struct Retention {
  std::int64_t seconds = 0;  ///< after the end of each
  std::int64_t jobs = 0;     ///< of them all, the newest
  std::int64_t bytes = 0;    ///< of uploads and artifacts, those of the newest
};

enum class RequeueReason { kWorkerCrashed, kServiceStopped };

/// How the process before this one ended, as far as it could say so itself.
enum class PreviousEnd {
  kOrderly,  ///< it stopped, or ended for a fault of the machine that it has named
  kKilled,   ///< from without, or with the machine: no fault of a job's
  kCrashed,  ///< of a signal of its own, or for want of memory: a job may be at fault
};

/// What tells a store from others and from its own past.
struct StoreIdentity {
  std::string id;               ///< of the database and the objects that belong to it
  std::int64_t generation = 0;  ///< number of starts of a service on it
};

/// The run of a job that ClaimNext has given to this process.
struct HeldRun {
  std::string id;
  std::int64_t run = 0;
};

/// What another process has done to a store that several share.
enum class StoreNews {
  kJobWaits,  ///< a job may be claimed
  kRunEnded,  ///< a running job was dismissed: Hold tells whose run that ends
};

/// A lock that ends with this object.
class ObjectLock {
 public:
  ObjectLock() = default;
  virtual ~ObjectLock() = default;
  ObjectLock(const ObjectLock&) = delete;
  ObjectLock& operator=(const ObjectLock&) = delete;
};

/// The table of all jobs. A change is durable when its call returns.
///
/// A store is of one process, or several share it. Where several do, a run is this process's for
/// the time of a lease, by the store's own clock, and Hold makes it anew: the run of a process that
/// died, froze or was cut off is over when its lease is, and the job's next run has another number.
///
/// Properties, which the conformance suite holds every implementation to:
/// (1) A job's state changes only as MayFollow allows.
/// (2) A call with a `run` has an effect only while the job is running and `run` is its current
///     run; otherwise the call returns false.
/// (3) One idempotency key of an owner makes at most one job.
/// (4) After each change of a job that it has, it calls its listener, whoever made the change: in a
///     store that several share, soon, and while somebody listens to its news.
/// (5) No time of a job is before one that the store had already, even where the clock goes back;
///     of two jobs that it has, the one that was inserted later has the greater id.
/// Errors, of every call: kIo where the store cannot be read or written; kResourceExhausted where
/// the disk is full, "no-space", or where it does not answer now, without a kind.
/// Threads: safe.
class JobStore {
 public:
  JobStore() = default;
  virtual ~JobStore() = default;
  JobStore(const JobStore&) = delete;
  JobStore& operator=(const JobStore&) = delete;

  /// Who is to be told of changes: called with the job's id, or with an empty text where any may
  /// have changed, from any thread. Requires: no other thread calls the store yet.
  void OnChange(std::function<void(const std::string& id)> listener) {
    listener_ = std::move(listener);
  }

  /// Stores an accepted job and returns it. If the store knows the idempotency key of the owner,
  /// stores nothing and returns the key's job.
  /// An input that was fetched is the same where its link is, whatever came of that.
  /// Errors: kInvalidArgument "idempotency-key-reused" where the key's job has another input, name,
  ///   process or subscriber, or other parameters; as CheckQueue, in the same transaction.
  virtual Result<Job> Insert(const NewJob& job, const QueueBounds& bounds, std::int64_t now_ms) = 0;

  /// The job that Insert would return without storing one; nullopt where it would store one. `job`
  /// need not have its input yet where it has its source. Errors: "idempotency-key-reused".
  virtual Result<std::optional<Job>> FindEarlier(const NewJob& job, std::int64_t now_ms) = 0;

  /// Succeeds if another job of `client` may wait. Errors: kResourceExhausted "too-many-jobs"
  ///   where as many of the client's do as may, "queue-full" where as many of all do.
  virtual Status CheckQueue(const std::string& client, const QueueBounds& bounds) = 0;

  /// Errors: kNotFound.
  virtual Result<Job> Find(const std::string& id) = 0;
  virtual Result<JobPage> List(const JobQuery& query) = 0;
  virtual Result<UnfinishedJobs> CountUnfinished() = 0;

  /// Makes an accepted job running, with the next run; nullopt if none may be started now. Of the
  /// jobs of the highest priority, every fourth time of all, it is one of the client with the
  /// fewest running jobs that was served the longest ago, and of that client's the oldest. A job
  /// that `room` is too small for, or that must run alone, for it ran while an earlier process
  /// crashed, lets others pass for ten minutes; then they wait for it.
  /// Requires: where no job runs, `room` has all that one may have.
  virtual Result<std::optional<Job>> ClaimNext(std::int64_t now_ms, const MemoryRoom& room) = 0;
  /// Fails the accepted jobs whose deadline has passed, "timeout"; returns their ids.
  virtual Result<std::vector<std::string>> FailOverdue(std::int64_t now_ms) = 0;
  virtual Result<bool> ReportProgress(const std::string& id, std::int64_t run, int progress,
                                      const std::string& message, std::int64_t now_ms) = 0;
  /// Replaces the job's assumptions, those of an earlier run too.
  virtual Result<bool> ReportAssumptions(const std::string& id, std::int64_t run,
                                         const Assumptions& assumptions, std::int64_t now_ms) = 0;
  virtual Result<bool> Publish(const std::string& id, std::int64_t run,
                               const std::vector<Artifact>& artifacts,
                               const std::map<std::string, double>& timings,
                               std::int64_t now_ms) = 0;
  virtual Result<bool> Fail(const std::string& id, std::int64_t run, const Error& failure,
                            std::int64_t now_ms) = 0;
  /// Makes the job accepted again. An end that the service has caused spends no attempt.
  virtual Result<bool> Requeue(const std::string& id, std::int64_t run, RequeueReason reason,
                               std::int64_t now_ms) = 0;
  /// Makes a job that needs more memory than was expected accepted again, with this estimate.
  virtual Result<bool> RequeueWithMemory(const std::string& id, std::int64_t run,
                                         std::int64_t memory_bytes, std::int64_t now_ms) = 0;
  /// Makes a job that a fault of the machine has ended accepted again, not to be started within
  /// `delay_ms`. Spends no attempt.
  virtual Result<bool> Postpone(const std::string& id, std::int64_t run, std::int64_t delay_ms,
                                std::int64_t now_ms) = 0;

  /// An accepted or running job becomes dismissed; a finished one is removed with its artifacts,
  /// and its objects become garbage. Returns the dismissed job. Errors: kNotFound.
  virtual Result<Job> Dismiss(const std::string& id, std::int64_t now_ms) = 0;
  /// Removes finished jobs as Dismiss does, the oldest first, at most a hundred; returns how many.
  virtual Result<std::int64_t> RemoveExpired(const Retention& retention, std::int64_t now_ms) = 0;

  /// Makes every running job accepted again and returns their number. The third crash of a process
  /// while a job ran fails the job, "poison-job". Of a store that several processes share, the jobs
  /// that ran in this one, by the folder that is its own. Requires: none of these runs, as at the
  /// start.
  virtual Result<std::int64_t> RecoverRunning(PreviousEnd end, std::int64_t now_ms) = 0;

  /// A call to a subscriber that is due: the one that has been for the longest time, for no other
  /// call before the lease ends, which is by the store's clock; nullopt where none is. An event is
  /// due from the change on that it tells of, in the same transaction; the start of a run is told
  /// of once, and no more after the job's end.
  virtual Result<std::optional<DueCallback>> ClaimCallback(std::chrono::milliseconds lease,
                                                           std::int64_t now_ms) = 0;
  /// Ends a claim: for good, or until `delay` is over. False where the claim was over: the job was
  /// removed, its end has overtaken the event, or another claim has followed.
  virtual Result<bool> EndCallback(const DueCallback& callback, CallbackEnd end) = 0;
  virtual Result<bool> RetryCallback(const DueCallback& callback, std::chrono::milliseconds delay,
                                     std::int64_t now_ms) = 0;

  /// The job's artifacts in the order of their names. Empty unless the job is successful.
  virtual Result<std::vector<Artifact>> Artifacts(const std::string& id) = 0;
  /// True if the object is the input or an artifact of a job, or of an upload.
  virtual Result<bool> IsReferenced(const std::string& sha256) = 0;
  /// Objects of jobs that were removed: each may be removed, too, unless it is referenced.
  virtual Result<std::vector<std::string>> Garbage() = 0;
  /// Takes these objects off the list of Garbage.
  virtual Status ForgetGarbage(const std::vector<std::string>& names) = 0;

  virtual Result<StoreIdentity> Identity() = 0;
  /// Counts a start of the service, and leaves it in the database's own file.
  virtual Result<StoreIdentity> BeginGeneration() = 0;

  /// Writes to the store; succeeds if what it wrote is durable.
  virtual Status Ping() = 0;

  /// Runs `work` in a transaction on the store's database, for tables beside that of the jobs; it
  /// is rolled back where `work` fails. `work` may be run again after a try that stored nothing.
  /// Errors: those of `work`, too.
  virtual Status Transact(const std::function<Status(SqlDatabase&)>& work) = 0;

  // What several processes need of a store that they share. As these calls stand here, they are
  // those of a store with one process.

  /// How long a run is this process's without a call of Hold; nullopt: as long as it lives.
  [[nodiscard]] virtual std::optional<std::chrono::milliseconds> LeaseTime() const { return {}; }
  /// Makes the leases of these runs anew. Returns the ids of those jobs whose run is over: the job
  /// was dismissed, or another process has it.
  virtual Result<std::vector<std::string>> Hold(const std::vector<HeldRun>& runs);
  /// Makes the running jobs whose lease is over accepted again, and returns their number. A job
  /// that has lost ten fails, "poison-job": it may be what ends the processes.
  virtual Result<std::int64_t> RecoverLost(std::int64_t /*now_ms*/) { return std::int64_t{0}; }
  /// Calls `handler` from now on with what other processes do, now and then for nothing; nullptr:
  /// no more, once the call has returned. News may be lost: whoever waits for them asks the store
  /// now and then. Requires: one handler at a time.
  virtual void Listen(std::function<void(StoreNews)> /*handler*/) {}

  /// No object is removed by anybody while the lock lives: objects are put, and the rows that name
  /// them are stored, under one lock. While a thread has it, its calls depend on it: where the lock
  /// is lost, with the connection that holds it, none of them stores anything.
  virtual Result<std::unique_ptr<ObjectLock>> PinObjects();
  /// Nobody has a lock of PinObjects while this one lives. nullptr where somebody has one: at once,
  /// or, if `wait`, where none was given back for as long as others may be kept waiting.
  virtual Result<std::unique_ptr<ObjectLock>> HaltPins(bool wait);

 protected:
  void Changed(const std::string& id) const {
    if (listener_) listener_(id);
  }

 private:
  std::function<void(const std::string& id)> listener_;
  std::shared_mutex pins_;
};

}  // namespace farhorizon

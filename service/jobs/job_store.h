#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "service/jobs/job.h"

namespace farhorizon {

/// A job as it is submitted; Insert makes an accepted job of it.
struct NewJob {
  std::string id;
  std::string filename;
  Parameters parameters;
  std::string input_sha256;
  std::int64_t input_bytes = 0;
  std::optional<std::string> idempotency_key;
  Assumptions assumptions = {};  ///< as far as they are known before it runs
};

/// The jobs that a page of the list is to have.
struct JobQuery {
  std::vector<JobState> states;       ///< empty: all
  std::optional<std::string> before;  ///< only jobs with a lesser id: the page's cursor
  int limit = 10;
};

/// Newest first. next: the cursor of the following page, unset on the last.
struct JobPage {
  std::vector<Job> jobs;
  std::optional<std::string> next;
};

enum class RequeueReason { kWorkerCrashed, kServiceStopped };

/// The table of all jobs. A change is durable when its call returns.
///
/// Properties, which the conformance suite holds every implementation to:
/// (1) A job's state changes only as MayFollow allows.
/// (2) A call with an `attempt` has an effect only while the job is running and `attempt` is its
///     current attempt; otherwise the call returns false.
/// (3) One idempotency key makes at most one job.
/// Errors, of every call: kIo where the store cannot be read or written, kResourceExhausted where
/// the disk is full.
/// Threads: safe.
class JobStore {
 public:
  JobStore() = default;
  virtual ~JobStore() = default;
  JobStore(const JobStore&) = delete;
  JobStore& operator=(const JobStore&) = delete;

  /// Stores an accepted job and returns it. If the store knows the idempotency key, stores nothing
  /// and returns the key's job.
  /// Errors: kInvalidArgument "idempotency-key-reused" where the key's job has another input, name
  ///   or other parameters.
  virtual Result<Job> Insert(const NewJob& job, std::int64_t now_ms) = 0;

  /// Errors: kNotFound.
  virtual Result<Job> Find(const std::string& id) = 0;
  virtual Result<JobPage> List(const JobQuery& query) = 0;
  virtual Result<std::int64_t> CountWaiting() = 0;

  /// Makes the oldest accepted job running, with the next attempt; nullopt if none is accepted.
  virtual Result<std::optional<Job>> ClaimNext(std::int64_t now_ms) = 0;
  virtual Result<bool> ReportProgress(const std::string& id, std::int64_t attempt, int progress,
                                      const std::string& message, std::int64_t now_ms) = 0;
  /// Replaces the job's assumptions, those of an earlier attempt too.
  virtual Result<bool> ReportAssumptions(const std::string& id, std::int64_t attempt,
                                         const Assumptions& assumptions, std::int64_t now_ms) = 0;
  virtual Result<bool> Publish(const std::string& id, std::int64_t attempt,
                               const std::vector<Artifact>& artifacts,
                               const std::map<std::string, double>& timings,
                               std::int64_t now_ms) = 0;
  virtual Result<bool> Fail(const std::string& id, std::int64_t attempt, const Error& failure,
                            std::int64_t now_ms) = 0;
  virtual Result<bool> Requeue(const std::string& id, std::int64_t attempt, RequeueReason reason,
                               std::int64_t now_ms) = 0;

  /// An accepted or running job becomes dismissed; a finished one is removed with its artifacts.
  /// Returns the dismissed job. Errors: kNotFound.
  virtual Result<Job> Dismiss(const std::string& id, std::int64_t now_ms) = 0;

  /// Makes every running job accepted again and returns their number. Requires: no job runs, as at
  /// the start of the only process on this store.
  virtual Result<std::int64_t> RecoverRunning(std::int64_t now_ms) = 0;

  /// The job's artifacts in the order of their names. Empty unless the job is successful.
  virtual Result<std::vector<Artifact>> Artifacts(const std::string& id) = 0;
  /// True if the object is the input or an artifact of a job.
  virtual Result<bool> IsReferenced(const std::string& sha256) = 0;

  /// Succeeds if the store can be written now.
  virtual Status Ping() = 0;
};

}  // namespace farhorizon

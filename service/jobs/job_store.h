#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "service/jobs/job.h"

namespace farhorizon {

/// What a client hands in; becomes an accepted job.
struct NewJob {
  std::string id;
  std::string filename;
  Parameters parameters;
  std::string input_sha256;
  std::int64_t input_bytes = 0;
  std::optional<std::string> idempotency_key;
};

struct JobQuery {
  std::vector<JobState> states;       ///< empty: all
  std::optional<std::string> before;  ///< only jobs whose id is less: the page's cursor
  int limit = 10;
};

/// Newest first. next: the cursor of the following page.
struct JobPage {
  std::vector<Job> jobs;
  std::optional<std::string> next;
};

enum class RequeueReason { kWorkerCrashed, kServiceStopped };

/// Where jobs live. Every call that changes something is durable when it returns.
///
/// Properties, which the conformance suite holds every implementation to:
/// (1) A change of state happens only where MayFollow allows it, and at most once.
/// (2) A word from a run (`attempt`) counts only while that run is the job's present one: the calls
///     that take an attempt answer false otherwise and change nothing.
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

  /// Stores an accepted job; `second` is true where the key's job was there already and is answered.
  /// Errors: kInvalidArgument "idempotency-key-reused" where the key came with another body or
  ///   other parameters.
  virtual Result<std::pair<Job, bool>> Insert(const NewJob& job, std::int64_t now_ms) = 0;

  /// Errors: kNotFound.
  virtual Result<Job> Find(const std::string& id) = 0;
  virtual Result<JobPage> List(const JobQuery& query) = 0;
  virtual Result<std::int64_t> CountWaiting() = 0;

  /// Takes the oldest accepted job and makes it running, with the next attempt.
  virtual Result<std::optional<Job>> ClaimNext(std::int64_t now_ms) = 0;
  virtual Result<bool> ReportProgress(const std::string& id, std::int64_t attempt, int progress,
                                      const std::string& message, std::int64_t now_ms) = 0;
  virtual Result<bool> Publish(const std::string& id, std::int64_t attempt,
                               const std::vector<Artifact>& artifacts,
                               const std::map<std::string, double>& timings,
                               std::int64_t now_ms) = 0;
  virtual Result<bool> Fail(const std::string& id, std::int64_t attempt, const Error& failure,
                            std::int64_t now_ms) = 0;
  virtual Result<bool> Requeue(const std::string& id, std::int64_t attempt, RequeueReason reason,
                               std::int64_t now_ms) = 0;

  /// An accepted or running job becomes dismissed; a finished one is removed with its artifacts.
  /// Answers the job as it is shown last: dismissed. Errors: kNotFound.
  virtual Result<Job> Dismiss(const std::string& id, std::int64_t now_ms) = 0;

  /// Makes every running job accepted again: for the start of the only process on this store.
  virtual Result<std::int64_t> RecoverRunning(std::int64_t now_ms) = 0;

  /// By name. Empty unless the job is successful.
  virtual Result<std::vector<Artifact>> Artifacts(const std::string& id) = 0;
  /// Whether any job's input or artifact is this object.
  virtual Result<bool> IsReferenced(const std::string& sha256) = 0;

  /// Whether the store can be written now.
  virtual Status Ping() = 0;
};

}  // namespace farhorizon

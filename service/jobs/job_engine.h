#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "service/jobs/job_runner.h"
#include "service/jobs/job_store.h"

namespace farhorizon {

/// What runs at once.
struct EngineLimits {
  int slots = 1;                                                         ///< jobs
  std::int64_t memory_bytes = std::numeric_limits<std::int64_t>::max();  ///< of them together
};

/// Takes accepted jobs from the store and runs as many at once as it has slots, and memory for
/// their costs.
/// Where the store gives runs for the time of a lease, a thread holds those of the jobs that run,
/// and stops the workers of runs that are over. A worker outlives no lease that the store, if it
/// does not answer, may have given to another process.
/// Threads: safe. Each slot is a thread that lives until Stop; a worker process dies with the
/// thread that started it.
class JobEngine {
 public:
  /// Requires: `jobs` and `runner` outlive this object.
  JobEngine(JobStore& jobs, JobRunner& runner, const EngineLimits& limits);
  ~JobEngine();
  JobEngine(const JobEngine&) = delete;
  JobEngine& operator=(const JobEngine&) = delete;

  /// To be called after a job was accepted: idle slots ask the store again.
  void Wake();
  /// Stops the job's worker, if it has one. Requires: the store has dismissed the job.
  void Cancel(const std::string& id);
  /// Takes no further job; running jobs go on.
  void StopTaking();
  /// Waits until no job runs, at most `most`; returns whether no job runs.
  bool WaitIdle(std::chrono::milliseconds most);
  /// Stops every worker; their jobs are accepted again. The last call.
  void Stop();

 private:
  using Clock = std::chrono::steady_clock;
  struct Running {
    std::stop_source stop;
    std::int64_t run = 0;
    Clock::time_point held;  // when the call began that gave or renewed its lease
  };

  void RunSlot();
  void RunHolder(std::chrono::milliseconds lease);
  void HoldAll(std::chrono::milliseconds lease);
  void OnNews(StoreNews news);
  /// Takes a job that there is memory for, and counts it as taken.
  Result<std::optional<Job>> Claim();

  JobStore& jobs_;
  JobRunner& runner_;
  const std::int64_t memory_bytes_;

  std::mutex claim_;  // one slot at a time: the memory that it takes is no other's. Before mutex_.
  std::mutex mutex_;
  std::int64_t taken_bytes_ = 0;
  std::condition_variable changed_;
  bool taking_ = true;
  bool stopping_ = false;
  std::uint64_t wakes_ = 0;
  int busy_ = 0;
  std::map<std::string, Running> running_;
  bool hold_now_ = false;
  std::vector<std::thread> slots_;
  std::thread holder_;
};

}  // namespace farhorizon

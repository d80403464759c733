#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <map>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "service/jobs/job_runner.h"
#include "service/jobs/job_store.h"

namespace farhorizon {

/// Takes accepted jobs from the store and runs as many at once as it has slots.
/// Threads: safe. Each slot is a thread that lives until Stop; a worker process dies with the
/// thread that started it.
class JobEngine {
 public:
  /// Requires: `jobs` and `runner` outlive this object.
  JobEngine(JobStore& jobs, JobRunner& runner, int slots);
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
  void RunSlot();

  JobStore& jobs_;
  JobRunner& runner_;

  std::mutex mutex_;
  std::condition_variable changed_;
  bool taking_ = true;
  bool stopping_ = false;
  std::uint64_t wakes_ = 0;
  int busy_ = 0;
  std::map<std::string, std::stop_source> running_;
  std::vector<std::thread> slots_;
};

}  // namespace farhorizon

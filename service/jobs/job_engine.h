#pragma once

#include <condition_variable>
#include <filesystem>
#include <map>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "core/base/result.h"
#include "service/jobs/job_store.h"
#include "service/jobs/object_keeper.h"
#include "service/jobs/object_store.h"
#include "service/worker/supervisor.h"

namespace farhorizon {

struct EngineOptions {
  std::string worker_program = "/proc/self/exe";
  int workers = 1;
  WorkerLimits limits;
  std::int64_t max_posts = 64'000'000;
  int threads_per_worker = 1;
};

/// Runs accepted jobs, each in a worker process, as many at once as it has slots.
///
/// A job's artifacts become visible by one conditional change of its row, after their objects are
/// durable. A worker that crashes is started once more, then its job fails.
/// Threads: safe. One thread a slot, for as long as this lives: workers die with theirs.
class JobEngine {
 public:
  JobEngine(JobStore& jobs, ObjectStore& objects, ObjectKeeper& keeper,
            std::filesystem::path work_directory, EngineOptions options);
  ~JobEngine();
  JobEngine(const JobEngine&) = delete;
  JobEngine& operator=(const JobEngine&) = delete;

  /// Says that a job may be waiting.
  void Wake();
  /// Stops the job's worker, if it has one. The store must have dismissed it before.
  void Cancel(const std::string& id);
  /// Takes no further job; those that run go on.
  void StopTaking();
  /// Waits until nothing runs, at most so long; whether that is so.
  bool WaitIdle(std::chrono::milliseconds most);
  /// Stops every worker and gives their jobs back. The last call.
  void Stop();

 private:
  void RunSlot();
  void RunJob(const Job& job, const std::stop_token& stop);
  Status Prepare(const Job& job, const std::filesystem::path& directory);
  void Settle(const Job& job, WorkerOutcome outcome, const std::filesystem::path& directory);
  void SettleCrash(const Job& job, const Error& error);
  Status Publish(const Job& job, const WorkerOutcome& outcome,
                 const std::filesystem::path& directory);
  void FailJob(const Job& job, const Error& error);
  Progress Reporting(const Job& job);
  bool Stopping();

  JobStore& jobs_;
  ObjectStore& objects_;
  ObjectKeeper& keeper_;
  std::filesystem::path work_directory_;
  EngineOptions options_;

  std::mutex mutex_;
  std::condition_variable_any changed_;
  bool taking_ = true;
  bool stopping_ = false;
  std::uint64_t wakes_ = 0;
  int busy_ = 0;
  std::map<std::string, std::stop_source> running_;
  std::vector<std::thread> slots_;
};

}  // namespace farhorizon

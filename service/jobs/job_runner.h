#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <stop_token>
#include <string>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "service/jobs/job_store.h"
#include "service/jobs/object_collector.h"
#include "service/jobs/object_store.h"
#include "service/jobs/run_ending.h"
#include "service/worker/supervisor.h"

namespace farhorizon {

/// How each job's worker is started.
struct RunnerOptions {
  std::string worker_program = "/proc/self/exe";
  WorkerLimits limits;
  std::int64_t max_posts = 64'000'000;
  int threads = 1;                             ///< of one worker
  std::shared_ptr<Spawner> spawner = nullptr;  ///< starts the workers
};

/// Runs one job in a worker process: input, worker, artifacts, final state.
///
/// A job's artifacts become visible by one conditional change of its row, after their objects are
/// durable. RunEnding decides what becomes of a job whose run does not get there.
/// Threads: safe.
class JobRunner {
 public:
  /// What the runner works with. Requires: all of it outlives the runner.
  struct Stores {
    JobStore& jobs;
    ObjectStore& objects;
    ObjectCollector& collector;
    StorageHealth& health;
  };
  JobRunner(const Stores& stores, std::filesystem::path work_directory, RunnerOptions options);

  /// The memory that the job's worker may take: as much as the job is expected to need, or as any
  /// may have where nobody knows.
  [[nodiscard]] std::int64_t MemoryOf(const Job& job) const;
  [[nodiscard]] std::int64_t MostMemory() const { return options_.limits.memory_bytes; }

  /// Runs `job` and stores how it ended. A stop ends the worker: then the job is accepted again,
  /// unless it was dismissed.
  void Run(const Job& job, const std::stop_token& stop);

 private:
  [[nodiscard]] WorkerLimits LimitsOf(const Job& job) const;
  Status Prepare(const Job& job, const std::filesystem::path& directory);
  void StoreOutcome(const Job& job, const WorkerOutcome& outcome,
                    const std::filesystem::path& directory, const std::stop_token& stop);
  Status Publish(const Job& job, const WorkerOutcome& outcome,
                 const std::filesystem::path& directory);
  Progress ReportTo(const Job& job);
  AssumptionHandler StoreAssumptionsOf(const Job& job);

  JobStore& jobs_;
  ObjectStore& objects_;
  ObjectCollector& collector_;
  RunEnding ending_;
  std::filesystem::path work_directory_;
  RunnerOptions options_;
};

}  // namespace farhorizon

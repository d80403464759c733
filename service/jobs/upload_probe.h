#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <semaphore>

#include "core/base/result.h"
#include "core/pipeline/build_options.h"
#include "service/jobs/job.h"
#include "service/jobs/job_runner.h"
#include "service/jobs/spool_file.h"
#include "service/worker/supervisor.h"
#include "service/worker/worker_protocol.h"

namespace farhorizon {

/// Limits of reading an upload before its job is accepted.
struct ProbeOptions {
  std::int64_t max_bytes = std::int64_t{1} << 31U;  ///< larger uploads are read by their job only
  /// What ends a probe for want of memory is no fault of the DEM: its job has more.
  std::int64_t memory_bytes = std::int64_t{1} << 28U;
  /// A probe reads the header of a large raster alone: it takes some 100 ms of a free core.
  std::int64_t wall_seconds = 5;
  int at_once = 0;  ///< more wait for these; 0: as MemoryPlan has it
};

/// What a probe has found out. cost: 0 where it did not get so far.
struct ProbeReport {
  Assumptions assumptions;
  JobCost cost;
};

/// Looks into uploads, each in a worker process with limits of its own: none waits for a job.
/// Threads: safe.
class UploadProbe {
 public:
  /// folder: for the probes' own. runner: how jobs are run, and what each may take.
  /// Requires: options.at_once > 0.
  UploadProbe(std::filesystem::path folder, const ProbeOptions& options, RunnerOptions runner);

  /// Reads, places and plans the upload, without building anything. Succeeds, with what is known by
  /// then, also where the limits of the probe end the worker: the job has larger ones.
  /// options: what `parameters` mean.
  /// Errors: those of TerrainInput::Open and PlanLevels; kResourceExhausted "memory-limit",
  ///   "timeout" where the job is expected to need more than one may have.
  Result<ProbeReport> Look(const SpoolFile& upload, const std::string& filename,
                           const Parameters& parameters, BuildOptions options);

 private:
  /// Runs one probe. assumptions: those that it tells.
  WorkerOutcome Run(const std::filesystem::path& directory, const WorkerTask& task,
                    Assumptions& assumptions);

  std::filesystem::path folder_;
  ProbeOptions options_;
  RunnerOptions runner_;
  std::atomic<std::int64_t> next_{0};
  std::counting_semaphore<> free_;
};

}  // namespace farhorizon

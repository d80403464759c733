#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "core/base/result.h"
#include "core/base/run_control.h"
#include "service/worker/spawner/spawner.h"
#include "service/worker/worker_limits.h"

namespace farhorizon {

enum class WorkerEnd {
  kDone,     ///< the worker sent that it is done, and exited with status 0
  kFailed,   ///< the worker sent an error of the data or the task; a second run would have it too
  kCrashed,  ///< the worker died, exceeded a limit or violated the protocol
  kStopped,  ///< a stop was requested
};

struct WorkerOutcome {
  WorkerEnd end = WorkerEnd::kCrashed;
  /// Set unless `end` is kDone. Of a crash, the kind is "worker-crashed", "worker-not-started",
  /// "worker-stuck", "memory-limit", "file-limit" or "timeout".
  Error error = {ErrorCode::kIo, "", ""};
  std::map<std::string, double> timings = {};
  std::int64_t peak_bytes = 0;  ///< resident memory at its peak, as a worker that is done says
  std::optional<std::int64_t> posts = {};  ///< of the DEM, where the worker has said so
  std::string stderr_tail = {};            ///< the end of the worker's standard error, for the log
};

/// How to start one worker process.
struct WorkerCall {
  std::string program;
  bool probe_only = false;          ///< read the raster, build nothing
  std::filesystem::path directory;  ///< the worker's own; contains task.json and the input
  WorkerLimits limits;
  std::shared_ptr<Spawner> spawner = nullptr;  ///< starts the worker
};

/// Runs a worker process to its end, and passes its progress and assumptions on to `control`.
/// Returns within the wall-clock limit and the time of a kill, whatever the worker does.
WorkerOutcome RunWorker(const WorkerCall& call, const RunControl& control);

}  // namespace farhorizon

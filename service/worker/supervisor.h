#pragma once

#include <filesystem>
#include <map>
#include <stop_token>
#include <string>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "service/worker/child.h"
#include "service/worker/message.h"

namespace farhorizon {

enum class WorkerEnd {
  kDone,     ///< it said so and ended well
  kFailed,   ///< it said why: the data's or the task's fault; trying again would not help
  kCrashed,  ///< it died, or was killed by a limit, or spoke nonsense
  kStopped,  ///< we were asked to stop it
};

struct WorkerOutcome {
  WorkerEnd end = WorkerEnd::kCrashed;
  Error error = {ErrorCode::kIo, "", ""};  ///< set unless kDone; kind "worker-crashed",
                                           ///< "memory-limit" or "timeout" where it crashed
  std::map<std::string, double> timings;
  std::string last_words;  ///< the end of its standard error, for the log
};

struct WorkerCall {
  std::string program = "/proc/self/exe";
  bool probe_only = false;          ///< read the raster, build nothing
  std::filesystem::path directory;  ///< its own; holds task.json and the input
  WorkerLimits limits;
};

/// Runs a worker process to its end and says how that was. Whatever the worker does, this returns
/// within the wall-clock limit and a moment.
WorkerOutcome RunWorker(const WorkerCall& call, const Progress& progress,
                        const std::stop_token& stop);

}  // namespace farhorizon

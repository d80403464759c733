#include "service/jobs/upload_probe.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <system_error>
#include <utility>

#include "core/pipeline/build_cost.h"
#include "core/pipeline/build_options.h"
#include "service/jobs/memory_plan.h"
#include "service/log.h"
#include "service/worker/supervisor.h"
#include "service/worker/worker_protocol.h"

namespace farhorizon {

namespace {

namespace fs = std::filesystem;

// A machine may be faster than the one that was measured, and ground smoother: only what takes many
// times as long as it may is refused for its time.
constexpr double kBenefitOfDoubt = 8;

WorkerLimits LimitsOf(const ProbeOptions& probe) {
  WorkerLimits limits;
  limits.memory_bytes = probe.memory_bytes;
  limits.cpu_seconds = probe.wall_seconds;
  limits.wall_seconds = probe.wall_seconds;
  limits.file_bytes = std::int64_t{1} << 20U;  // a probe writes only what goes to standard error
  limits.folder_bytes = 2 * limits.file_bytes;
  return limits;
}

// The cost of a job on so many posts, or why no worker may have as much.
Result<JobCost> Judge(std::int64_t posts, const BuildOptions& options,
                      const RunnerOptions& runner) {
  const BuildCost cost = EstimateBuild(posts, options);
  const std::string begin =
      "the DEM has " + std::to_string(posts) + " posts, for which a job needs ";
  if (cost.memory_bytes > runner.limits.memory_bytes) {
    return Error{ErrorCode::kResourceExhausted,
                 begin + "some " + Mebibytes(cost.memory_bytes) + " of memory, and one may have " +
                     Mebibytes(runner.limits.memory_bytes) +
                     " here; cut it into pieces of at most " +
                     std::to_string(PostsWithin(runner.limits.memory_bytes, options)) + " posts",
                 "memory-limit"};
  }
  const std::int64_t wall = runner.limits.wall_seconds * runner.threads;
  const std::int64_t most = std::min(runner.limits.cpu_seconds, wall);
  if (cost.cpu_seconds > kBenefitOfDoubt * static_cast<double>(most)) {
    return Error{ErrorCode::kResourceExhausted,
                 begin + "some " + std::to_string(std::llround(cost.cpu_seconds)) +
                     " seconds of a processor, and one may have " + std::to_string(most) +
                     " here; send a smaller DEM",
                 "timeout"};
  }
  return JobCost{cost.memory_bytes, std::llround(std::ceil(cost.cpu_seconds))};
}

}  // namespace

UploadProbe::UploadProbe(fs::path folder, const ProbeOptions& options, RunnerOptions runner)
    : folder_(std::move(folder)),
      options_(options),
      runner_(std::move(runner)),
      free_(options.at_once) {}

WorkerOutcome UploadProbe::Run(const fs::path& directory, const WorkerTask& task,
                               Assumptions& assumptions) {
  WorkerOutcome outcome;
  if (Status written = WriteTaskFile(directory, task); !written) {
    outcome.error = std::move(written.error());
    return outcome;
  }
  free_.acquire();
  outcome =
      RunWorker({runner_.worker_program, true, directory, LimitsOf(options_), runner_.spawner},
                {.on_assumption = [&](const Assumption& met) { assumptions.push_back(met); }});
  free_.release();
  if (outcome.end == WorkerEnd::kCrashed) {
    Log(LogLevel::kWarning, "probe crashed",
        {{"code", outcome.error.kind}, {"last_words", outcome.stderr_tail}});
  }
  return outcome;
}

Result<ProbeReport> UploadProbe::Look(const SpoolFile& upload, const std::string& filename,
                                      const Parameters& parameters, BuildOptions options) {
  ProbeReport report;
  if (upload.bytes() > options_.max_bytes) return report;
  options.threads = runner_.threads;
  const fs::path directory = folder_ / ("probe-" + std::to_string(next_++));
  const fs::path input = fs::path("in") / filename;
  std::error_code failure;
  fs::create_directories(directory / "in", failure);
  // The upload is not an object of the store yet. So a hard link suffices: by writing to it, a
  // worker could damage only its own input.
  if (!failure) fs::create_hard_link(upload.path(), directory / input, failure);
  if (failure) {
    fs::remove_all(directory, failure);
    return report;
  }
  WorkerOutcome outcome =
      Run(directory, {input.string(), "", parameters, runner_.max_posts, 1}, report.assumptions);
  fs::remove_all(directory, failure);
  // A worker that runs out of the probe's memory says so itself; a job may have more.
  if (outcome.end == WorkerEnd::kFailed && outcome.error.kind != "memory-limit") {
    return std::move(outcome.error);
  }
  if (!outcome.posts) return report;
  Result<JobCost> cost = Judge(*outcome.posts, options, runner_);
  if (!cost) return std::move(cost.error());
  report.cost = *cost;
  return report;
}

}  // namespace farhorizon

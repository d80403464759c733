#include "service/jobs/job_service.h"

#include <system_error>

#include "service/clock.h"
#include "service/jobs/local_object_store.h"
#include "service/jobs/sqlite_job_store.h"
#include "service/jobs/storage_file.h"
#include "service/log.h"
#include "service/worker/worker_protocol.h"

namespace farhorizon {

namespace {

namespace fs = std::filesystem;

WorkerLimits ProbeLimits(const ProbeOptions& probe) {
  WorkerLimits limits;
  limits.memory_bytes = probe.memory_bytes;
  limits.cpu_seconds = probe.wall_seconds;
  limits.wall_seconds = probe.wall_seconds;
  limits.file_bytes = std::int64_t{1} << 20U;  // a probe writes only what goes to standard error
  return limits;
}

}  // namespace

Result<std::unique_ptr<JobService>> JobService::Open(JobServiceOptions options) {
  Result<DataDirectory> directory = OpenDataDirectory(options.data);
  if (!directory) return std::move(directory.error());
  Result<std::unique_ptr<JobStore>> jobs = OpenSqliteJobStore(directory->Jobs());
  if (!jobs) return std::move(jobs.error());
  Result<std::unique_ptr<ObjectStore>> objects = OpenLocalObjectStore(directory->Objects());
  if (!objects) return std::move(objects.error());
  Result<std::int64_t> recovered = (*jobs)->RecoverRunning(NowMs());
  if (!recovered) return std::move(recovered.error());
  if (*recovered > 0) Log(LogLevel::kWarning, "jobs taken up again", {{"jobs", *recovered}});
  Status cleared = ObjectCollector(**jobs, **objects).RemoveAllUnreferenced();
  if (!cleared) return std::move(cleared.error());
  return std::unique_ptr<JobService>(new JobService(std::move(options), *std::move(directory),
                                                    *std::move(jobs), *std::move(objects)));
}

JobService::JobService(JobServiceOptions options, DataDirectory directory,
                       std::unique_ptr<JobStore> jobs, std::unique_ptr<ObjectStore> objects)
    : options_(std::move(options)),
      directory_(std::move(directory)),
      jobs_(std::move(jobs)),
      objects_(std::move(objects)),
      collector_(*jobs_, *objects_),
      probes_(options_.workers),
      runner_(*jobs_, *objects_, collector_, directory_.Work(), options_.runner),
      engine_(std::make_unique<JobEngine>(*jobs_, runner_, options_.workers)) {}

JobService::~JobService() = default;

Status JobService::CheckDisk() {
  Result<std::int64_t> room = FreeBytes(directory_.root);
  if (!room) return std::move(room.error());
  if (*room >= options_.min_free_bytes) return Ok{};
  return Error{ErrorCode::kResourceExhausted,
               "the disk has less than " + std::to_string(options_.min_free_bytes) +
                   " bytes left; try later, or dismiss finished jobs",
               "no-space"};
}

Status JobService::CheckRoom() {
  if (draining_) {
    return Error{ErrorCode::kResourceExhausted, "the service is being stopped; try again soon",
                 "draining"};
  }
  Status disk = CheckDisk();
  if (!disk) return disk;
  Result<std::int64_t> waiting = jobs_->CountWaiting();
  if (!waiting) return std::move(waiting.error());
  if (*waiting < options_.max_waiting) return Ok{};
  return Error{ErrorCode::kResourceExhausted,
               std::to_string(*waiting) + " jobs are waiting, as many as may; try again later",
               "queue-full"};
}

Status JobService::CheckReady() {
  if (draining_) return CheckRoom();
  Status written = jobs_->Ping();
  if (!written) return written;
  return CheckDisk();
}

Result<Assumptions> JobService::Probe(const SpoolFile& upload, const Submission& submission) {
  Assumptions assumptions;
  if (upload.bytes() > options_.probe.max_bytes) return assumptions;
  const fs::path directory = directory_.Work() / ("probe-" + std::to_string(next_probe_++));
  const fs::path input = fs::path("in") / submission.filename;
  std::error_code failure;
  fs::create_directories(directory / "in", failure);
  // The upload is not an object of the store yet. So a hard link suffices: by writing to it, a
  // worker could damage only its own input.
  if (!failure) fs::create_hard_link(upload.path(), directory / input, failure);
  const RunnerOptions& runner = options_.runner;
  const WorkerTask task{input.string(), "", submission.parameters, runner.max_posts, 1};
  std::optional<Error> refusal;
  if (!failure && WriteTaskFile(directory, task)) {
    probes_.acquire();
    WorkerOutcome outcome = RunWorker(
        {runner.worker_program, true, directory, ProbeLimits(options_.probe), runner.spawner},
        {.on_assumption = [&](const Assumption& met) { assumptions.push_back(met); }});
    probes_.release();
    // A worker that runs out of the probe's memory says so itself; a job may have more.
    if (outcome.end == WorkerEnd::kFailed && outcome.error.kind != "memory-limit") {
      refusal = std::move(outcome.error);
    } else if (outcome.end == WorkerEnd::kCrashed) {
      Log(LogLevel::kWarning, "probe crashed",
          {{"code", outcome.error.kind}, {"last_words", outcome.stderr_tail}});
    }
  }
  fs::remove_all(directory, failure);
  if (refusal) return *std::move(refusal);
  return assumptions;
}

Result<Job> JobService::Submit(const SpoolFile& upload, const Submission& submission) {
  auto pin = collector_.Pin();
  Result<StoredObject> stored = objects_->PutFile(upload.path());
  if (!stored) return std::move(stored.error());
  const std::int64_t now = NowMs();
  Result<Job> inserted =
      jobs_->Insert({NewJobId(now), submission.filename, submission.parameters, stored->sha256,
                     stored->bytes, submission.idempotency_key, submission.assumptions},
                    now);
  pin.unlock();
  if (inserted) {
    engine_->Wake();
    return inserted;
  }
  Status removed = collector_.RemoveUnreferenced({stored->sha256});
  if (!removed) Log(LogLevel::kWarning, "an object is left", {{"error", removed.error().message}});
  return inserted;
}

Result<OpenArtifact> JobService::Open(const std::string& id, const std::string& name) {
  Result<std::vector<Artifact>> artifacts = jobs_->Artifacts(id);
  if (!artifacts) return std::move(artifacts.error());
  for (Artifact& artifact : *artifacts) {
    if (artifact.name != name) continue;
    Result<OpenObject> object = objects_->Open(artifact.sha256);
    if (object && object->bytes == artifact.bytes) {
      return OpenArtifact{std::move(artifact), *std::move(object)};
    }
    // If the job is gone by now, it was dismissed between the two calls. If not, the object is
    // lost.
    Result<Job> job = jobs_->Find(id);
    if (!job) return std::move(job.error());
    return Error{ErrorCode::kIo, "this artifact is damaged or lost; submit the DEM again",
                 "result-corrupt"};
  }
  return Error{ErrorCode::kNotFound, "the job has no artifact of this name", "no-such-output"};
}

Result<Job> JobService::Dismiss(const std::string& id) {
  Result<Job> before = jobs_->Find(id);
  if (!before) return before;
  Result<std::vector<Artifact>> artifacts = jobs_->Artifacts(id);
  if (!artifacts) return std::move(artifacts.error());
  Result<Job> dismissed = jobs_->Dismiss(id, NowMs());
  if (!dismissed) return dismissed;
  engine_->Cancel(id);
  std::vector<std::string> names = {before->input_sha256};
  for (const Artifact& artifact : *artifacts) names.push_back(artifact.sha256);
  Status removed = collector_.RemoveUnreferenced(names);
  if (!removed) Log(LogLevel::kWarning, "objects are left", {{"error", removed.error().message}});
  return dismissed;
}

SandboxLayers JobService::ActiveSandbox() const {
  return options_.runner.spawner ? options_.runner.spawner->Layers() : SandboxLayers{};
}

void JobService::Drain() {
  draining_ = true;
  engine_->StopTaking();
}

}  // namespace farhorizon

#include "service/jobs/job_engine.h"

#include <algorithm>
#include <chrono>
#include <fstream>
#include <memory>
#include <optional>
#include <system_error>

#include "core/pipeline/progress_plan.h"
#include "service/clock.h"
#include "service/jobs/collect_artifacts.h"
#include "service/log.h"
#include "service/worker/message.h"

namespace farhorizon {

namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds kBetweenReports{500};
constexpr std::chrono::milliseconds kBetweenTries{1000};
constexpr std::int64_t kCrashesForgiven = 1;

}  // namespace

JobEngine::JobEngine(JobStore& jobs, ObjectStore& objects, ObjectKeeper& keeper,
                     fs::path work_directory, EngineOptions options)
    : jobs_(jobs),
      objects_(objects),
      keeper_(keeper),
      work_directory_(std::move(work_directory)),
      options_(std::move(options)) {
  for (int i = 0; i < options_.workers; ++i) slots_.emplace_back([this] { RunSlot(); });
}

JobEngine::~JobEngine() { Stop(); }

void JobEngine::Wake() {
  const std::lock_guard lock(mutex_);
  ++wakes_;
  changed_.notify_all();
}

void JobEngine::Cancel(const std::string& id) {
  const std::lock_guard lock(mutex_);
  const auto found = running_.find(id);
  if (found != running_.end()) found->second.request_stop();
}

void JobEngine::StopTaking() {
  const std::lock_guard lock(mutex_);
  taking_ = false;
  changed_.notify_all();
}

bool JobEngine::WaitIdle(std::chrono::milliseconds most) {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, most, [this] { return busy_ == 0; });
}

void JobEngine::Stop() {
  {
    const std::lock_guard lock(mutex_);
    taking_ = false;
    stopping_ = true;
    for (auto& [id, stop] : running_) stop.request_stop();
    changed_.notify_all();
  }
  for (std::thread& slot : slots_) slot.join();
  slots_.clear();
}

bool JobEngine::Stopping() {
  const std::lock_guard lock(mutex_);
  return stopping_;
}

void JobEngine::RunSlot() {
  std::unique_lock lock(mutex_);
  std::uint64_t seen = 0;
  while (taking_) {
    seen = wakes_;
    ++busy_;
    lock.unlock();
    Result<std::optional<Job>> job = jobs_.ClaimNext(NowMs());
    std::stop_source stop;
    lock.lock();
    if (job && *job) {
      running_[(*job)->id] = stop;
      if (stopping_) stop.request_stop();
      lock.unlock();
      RunJob(**job, stop.get_token());
      lock.lock();
      running_.erase((*job)->id);
    }
    --busy_;
    changed_.notify_all();
    if (job && *job) continue;
    if (!job) Log(LogLevel::kError, "cannot take a job", {{"error", job.error().message}});
    // Woken by a submission; by the clock where the store could not be asked.
    const auto something_new = [&] { return !taking_ || wakes_ != seen; };
    if (job) {
      changed_.wait(lock, something_new);
    } else {
      changed_.wait_for(lock, kBetweenTries, something_new);
    }
  }
}

void JobEngine::RunJob(const Job& job, const std::stop_token& stop) {
  Log(LogLevel::kInfo, "job starts", {{"job_id", job.id}, {"attempt", job.attempt}});
  const fs::path directory = work_directory_ / (job.id + "-" + std::to_string(job.attempt));
  try {
    // A dismissal between the claim and now found no worker to stop.
    Result<bool> ours = jobs_.ReportProgress(job.id, job.attempt, 0, "starting", NowMs());
    if (ours && !*ours) return;
    Status prepared = Prepare(job, directory);
    if (!prepared) {
      FailJob(job, prepared.error());
    } else {
      const WorkerCall call{options_.worker_program, false, directory, options_.limits};
      Settle(job, RunWorker(call, Reporting(job), stop), directory);
    }
  } catch (const std::exception& bug) {
    Log(LogLevel::kError, "internal error", {{"job_id", job.id}, {"error", bug.what()}});
    FailJob(job,
            {ErrorCode::kIo, "the service failed inside; the fault is ours", "internal-error"});
  }
  std::error_code ignored;
  fs::remove_all(directory, ignored);
}

Status JobEngine::Prepare(const Job& job, const fs::path& directory) {
  std::error_code failure;
  fs::remove_all(directory, failure);
  fs::create_directories(directory / "in", failure);
  if (!failure) fs::create_directory(directory / "out", failure);
  if (failure) {
    return Error{ErrorCode::kIo, "make a working folder: " + failure.message(), "storage"};
  }
  const fs::path input = fs::path("in") / job.filename;
  Status copied = objects_.Materialise(job.input_sha256, directory / input);
  if (!copied) return copied;
  std::ofstream task(directory / "task.json", std::ios::binary);
  task << WriteTask(
      {input.string(), "out", job.parameters, options_.max_posts, options_.threads_per_worker});
  task.close();
  if (!task) return Error{ErrorCode::kIo, "write the worker's task", "storage"};
  return Done{};
}

Progress JobEngine::Reporting(const Job& job) {
  using Clock = std::chrono::steady_clock;
  struct Shown {
    OverallProgress overall{Workflow::kBuild};
    std::optional<Stage> stage;
    Clock::time_point at;
  };
  return [this, id = job.id, attempt = job.attempt, shown = std::make_shared<Shown>()](
             Stage stage, double done) {
    const int percent = shown->overall.Percent(stage, done);
    const Clock::time_point now = Clock::now();
    if (shown->stage == stage && now - shown->at < kBetweenReports) return;
    if (shown->stage != stage && now - shown->at < kBetweenReports / 5) return;
    shown->stage = stage;
    shown->at = now;
    Result<bool> told = jobs_.ReportProgress(id, attempt, percent, StageName(stage), NowMs());
    if (!told) Log(LogLevel::kWarning, "progress lost", {{"error", told.error().message}});
  };
}

void JobEngine::Settle(const Job& job, WorkerOutcome outcome, const fs::path& directory) {
  switch (outcome.end) {
    case WorkerEnd::kDone: {
      Status published = Publish(job, outcome, directory);
      if (!published) FailJob(job, published.error());
      return;
    }
    case WorkerEnd::kFailed:
      FailJob(job, outcome.error);
      return;
    case WorkerEnd::kCrashed:
      Log(LogLevel::kError, "worker crashed",
          {{"job_id", job.id},
           {"code", outcome.error.kind},
           {"error", outcome.error.message},
           {"last_words", outcome.last_words}});
      SettleCrash(job, outcome.error);
      return;
    case WorkerEnd::kStopped:
      // Dismissed already, and then nothing changes here; or the service is on its way down.
      Result<bool> given_back =
          jobs_.Requeue(job.id, job.attempt, RequeueReason::kServiceStopped, NowMs());
      Log(LogLevel::kInfo, "job stopped",
          {{"job_id", job.id}, {"requeued", std::int64_t{given_back && *given_back ? 1 : 0}}});
      return;
  }
}

void JobEngine::SettleCrash(const Job& job, const Error& error) {
  // Out of time once is out of time twice; memory may have been short for a neighbour's sake.
  const bool hopeless = error.kind == "timeout" || error.kind == "file-limit";
  if (hopeless || job.crash_count >= kCrashesForgiven) return FailJob(job, error);
  Result<bool> again = jobs_.Requeue(job.id, job.attempt, RequeueReason::kWorkerCrashed, NowMs());
  if (!again) {
    Log(LogLevel::kError, "cannot requeue", {{"job_id", job.id}, {"error", again.error().message}});
  }
}

Status JobEngine::Publish(const Job& job, const WorkerOutcome& outcome, const fs::path& directory) {
  std::vector<std::string> objects;
  {
    const auto held = keeper_.Hold();
    Result<std::vector<Artifact>> artifacts = CollectArtifacts(directory / "out", objects_);
    if (!artifacts) return std::move(artifacts.error());
    Result<bool> published =
        jobs_.Publish(job.id, job.attempt, *artifacts, outcome.timings, NowMs());
    if (!published) return std::move(published.error());
    if (*published) {
      const std::int64_t took = NowMs() - job.started_ms.value_or(job.created_ms);
      Log(LogLevel::kInfo, "job successful", {{"job_id", job.id}, {"dur_ms", took}});
      return Done{};
    }
    for (const Artifact& artifact : *artifacts) objects.push_back(artifact.sha256);
  }
  // Dismissed meanwhile: the output goes the way of the job.
  return keeper_.RemoveUnnamed(objects);
}

void JobEngine::FailJob(const Job& job, const Error& error) {
  for (;;) {
    Result<bool> failed = jobs_.Fail(job.id, job.attempt, error, NowMs());
    if (failed) break;
    // The store is out of order: the job stays running in it, and recovery takes it up at the next
    // start if it does not come back before.
    Log(LogLevel::kError, "cannot store a failure",
        {{"job_id", job.id}, {"error", failed.error().message}});
    std::unique_lock lock(mutex_);
    if (changed_.wait_for(lock, kBetweenTries, [this] { return stopping_; })) return;
  }
  Log(LogLevel::kWarning, "job failed",
      {{"job_id", job.id}, {"code", error.kind}, {"error", error.message}});
}

}  // namespace farhorizon

#include "service/jobs/job_runner.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <new>
#include <optional>
#include <system_error>

#include "core/pipeline/progress_plan.h"
#include "service/clock.h"
#include "service/jobs/collect_artifacts.h"
#include "service/jobs/compressed_copies.h"
#include "service/log.h"
#include "service/metrics.h"
#include "service/worker/worker_protocol.h"

namespace farhorizon {

namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds kReportInterval{500};

}  // namespace

JobRunner::JobRunner(const Stores& stores, fs::path work_directory, RunnerOptions options)
    : jobs_(stores.jobs),
      objects_(stores.objects),
      collector_(stores.collector),
      ending_(stores.jobs, stores.health),
      work_directory_(std::move(work_directory)),
      options_(std::move(options)) {}

std::int64_t JobRunner::MemoryOf(const Job& job) const {
  const std::int64_t most = MostMemory();
  return job.cost.memory_bytes > 0 ? std::min(job.cost.memory_bytes, most) : most;
}

// Of time, the least of what the service, the client's timeout and the rest of the deadline leave.
WorkerLimits JobRunner::LimitsOf(const Job& job) const {
  WorkerLimits limits = options_.limits;
  limits.memory_bytes = MemoryOf(job);
  const auto shorten = [&limits](std::int64_t seconds, const char* bound) {
    if (seconds >= limits.wall_seconds) return;
    limits.wall_seconds = std::max<std::int64_t>(1, seconds);
    limits.wall_bound = bound;
  };
  if (job.timeout_seconds > 0) shorten(job.timeout_seconds, "the timeout that came with it");
  if (job.deadline_ms)
    shorten((*job.deadline_ms - NowMs()) / 1000, "what its deadline left of them");
  return limits;
}

void JobRunner::Run(const Job& job, const std::stop_token& stop) {
  CountJobStart(std::chrono::milliseconds(NowMs() - job.created_ms));
  Log(LogLevel::kInfo, "job starts",
      {{"job_id", job.id},
       {"attempt", job.attempt},
       {"memory_bytes", MemoryOf(job)},
       {"expected_seconds", job.cost.seconds}});
  const fs::path directory = work_directory_ / (job.id + "-" + std::to_string(job.run));
  try {
    // A dismissal between the claim and this line had no worker to stop.
    Result<bool> current = jobs_.ReportProgress(job.id, job.run, 0, "starting", NowMs());
    if (current && !*current) return;
    if (job.failure) return ending_.DataFailed(job, *job.failure, stop);  // of its row
    Status prepared = Prepare(job, directory);
    if (!prepared) {
      ending_.Failed(job, prepared.error(), stop);
    } else {
      const WorkerCall call{options_.worker_program, false, directory, LimitsOf(job),
                            options_.spawner};
      const RunControl control{ReportTo(job), stop, {}, StoreAssumptionsOf(job)};
      StoreOutcome(job, RunWorker(call, control), directory, stop);
    }
  } catch (const std::bad_alloc&) {
    ending_.Failed(job, {ErrorCode::kResourceExhausted, "the service is out of memory"}, stop);
  } catch (const std::exception& bug) {
    Log(LogLevel::kError, "internal error", {{"job_id", job.id}, {"error", bug.what()}});
    ending_.Failed(
        job, {ErrorCode::kIo, "the service failed inside; the fault is ours", "internal-error"},
        stop);
  }
  std::error_code ignored;
  fs::remove_all(directory, ignored);
}

Status JobRunner::Prepare(const Job& job, const fs::path& directory) {
  std::error_code failure;
  fs::remove_all(directory, failure);
  fs::create_directories(directory / "in", failure);
  if (!failure) fs::create_directory(directory / "out", failure);
  if (failure) {
    return Error{ErrorCode::kIo, "make a working folder: " + failure.message(), "storage"};
  }
  const fs::path input = fs::path("in") / job.filename;
  Status copied = objects_.CopyTo(job.input_sha256, directory / input);
  if (!copied && copied.error().code == ErrorCode::kNotFound) {
    return Error{ErrorCode::kIo, "the stored upload is lost; send it again", "input-corrupt"};
  }
  if (!copied) return copied;
  return WriteTaskFile(directory, {input.string(), "out", job.parameters, options_.max_posts,
                                   options_.threads, job.process == kEchoProcess});
}

// Stores a new stage at most ten times a second, and the share of one that is done at most twice.
Progress JobRunner::ReportTo(const Job& job) {
  using Clock = std::chrono::steady_clock;
  struct Shown {
    OverallProgress overall{Workflow::kBuild};
    std::optional<Stage> stage;
    Clock::time_point at;
  };
  return [this, id = job.id, run = job.run, shown = std::make_shared<Shown>()](Stage stage,
                                                                               double done) {
    const int percent = shown->overall.Percent(stage, done);
    const Clock::time_point now = Clock::now();
    if (shown->stage == stage && now - shown->at < kReportInterval) return;
    if (shown->stage != stage && now - shown->at < kReportInterval / 5) return;
    shown->stage = stage;
    shown->at = now;
    Result<bool> stored = jobs_.ReportProgress(id, run, percent, StageName(stage), NowMs());
    if (!stored) Log(LogLevel::kWarning, "progress lost", {{"error", stored.error().message}});
  };
}

// Those of this run alone, so that a second run does not double what the first has stored.
AssumptionHandler JobRunner::StoreAssumptionsOf(const Job& job) {
  return [this, id = job.id, run = job.run,
          met = std::make_shared<Assumptions>()](const Assumption& assumption) {
    met->push_back(assumption);
    Log(LogLevel::kInfo, "assumed",
        {{"job_id", id}, {"code", assumption.code}, {"text", assumption.text}});
    Result<bool> stored = jobs_.ReportAssumptions(id, run, *met, NowMs());
    if (!stored) Log(LogLevel::kWarning, "assumption lost", {{"error", stored.error().message}});
  };
}

void JobRunner::StoreOutcome(const Job& job, const WorkerOutcome& outcome,
                             const fs::path& directory, const std::stop_token& stop) {
  switch (outcome.end) {
    case WorkerEnd::kDone: {
      Status published = Publish(job, outcome, directory);
      if (!published) ending_.Failed(job, published.error(), stop);
      return;
    }
    case WorkerEnd::kFailed:
      // Rougher ground than was expected: twice as much, until it is as much as any may have.
      if (outcome.error.kind == "memory-limit" && MemoryOf(job) < MostMemory()) {
        return ending_.ShortOfMemory(job, std::min(2 * MemoryOf(job), MostMemory()), stop);
      }
      ending_.WorkerFailed(job, outcome.error, stop);
      return;
    case WorkerEnd::kCrashed:
      Log(LogLevel::kError, "worker crashed",
          {{"job_id", job.id},
           {"code", outcome.error.kind},
           {"error", outcome.error.message},
           {"last_words", outcome.stderr_tail}});
      ending_.WorkerCrashed(job, outcome.error, stop);
      return;
    case WorkerEnd::kStopped:
      ending_.Stopped(job, stop);
      return;
  }
}

Status JobRunner::Publish(const Job& job, const WorkerOutcome& outcome, const fs::path& directory) {
  std::vector<std::string> objects;
  {
    const auto pin = collector_.Pin();
    if (!pin) return pin.error();
    Result<std::vector<Artifact>> artifacts = CollectArtifacts(directory / "out", objects_);
    if (!artifacts) return std::move(artifacts.error());
    Status copied = AddCompressedCopies(*artifacts, objects_, work_directory_);
    if (!copied) return copied;
    Result<bool> published = jobs_.Publish(job.id, job.run, *artifacts, outcome.timings, NowMs());
    if (!published) return std::move(published.error());
    objects = ObjectsOf(*artifacts);
    if (*published) {
      objects_.Keep(objects);
      const std::int64_t took = NowMs() - job.started_ms.value_or(job.created_ms);
      CountJobEnd("successful", "");
      CountStages(outcome.timings);
      Log(LogLevel::kInfo, "job successful",
          {{"job_id", job.id}, {"dur_ms", took}, {"peak_bytes", outcome.peak_bytes}});
      return Ok{};
    }
  }
  // The job was dismissed while it ran: no row references its artifacts.
  return collector_.RemoveUnreferenced(objects);
}

}  // namespace farhorizon

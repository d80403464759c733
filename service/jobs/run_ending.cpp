#include "service/jobs/run_ending.h"

#include <algorithm>
#include <chrono>
#include <cstdint>

#include "service/clock.h"
#include "service/jobs/storage_file.h"
#include "service/log.h"
#include "service/metrics.h"
#include "service/random.h"

namespace farhorizon {

namespace {

constexpr std::chrono::milliseconds kRetryInterval{1000};
constexpr std::int64_t kMaxRestarts = 1;
// Half a minute is soon enough for a disk that an operator has cleared.
constexpr std::chrono::milliseconds kFirstRetryDelay{1000};
constexpr std::chrono::milliseconds kLongestRetryDelay{30'000};
// Of a fault that only the worker has seen. It may be true (a file system that is full for a
// moment) or a lie of a worker that a file has taken over.
constexpr std::int64_t kMostBelieved = 8;

}  // namespace

void RunEnding::Failed(const Job& job, const Error& error, const std::stop_token& stop) {
  if (IsMachineFault(error)) return Postpone(job, error, stop);
  DataFailed(job, error, stop);
}

void RunEnding::WorkerFailed(const Job& job, const Error& error, const std::stop_token& stop) {
  const bool believed = job.retries < kMostBelieved || !health_.CheckWrites();
  if (IsMachineFault(error) && believed) return Postpone(job, error, stop);
  DataFailed(job, error, stop);
}

void RunEnding::WorkerCrashed(const Job& job, const Error& error, const std::stop_token& stop) {
  if (IsMachineFault(error)) return Postpone(job, error, stop);
  const Status writes = health_.CheckWrites();
  if (!writes) return Postpone(job, writes.error(), stop);
  // A second run would exceed the same limit of time or file size again. Memory may have been short
  // because another job used it.
  const bool repeatable = error.kind == "timeout" || error.kind == "file-limit";
  if (repeatable || job.crash_count >= kMaxRestarts) return DataFailed(job, error, stop);
  StoreSurely(job, stop, [&] {
    return jobs_.Requeue(job.id, job.run, RequeueReason::kWorkerCrashed, NowMs());
  });
}

void RunEnding::ShortOfMemory(const Job& job, std::int64_t memory_bytes,
                              const std::stop_token& stop) {
  Log(LogLevel::kInfo, "the job needs more memory than was expected",
      {{"job_id", job.id}, {"memory_bytes", memory_bytes}});
  StoreSurely(job, stop,
              [&] { return jobs_.RequeueWithMemory(job.id, job.run, memory_bytes, NowMs()); });
}

void RunEnding::Stopped(const Job& job, const std::stop_token& stop) {
  const bool requeued = StoreSurely(job, stop, [&] {
    return jobs_.Requeue(job.id, job.run, RequeueReason::kServiceStopped, NowMs());
  });
  Log(LogLevel::kInfo, "job stopped",
      {{"job_id", job.id}, {"requeued", std::int64_t{requeued ? 1 : 0}}});
}

void RunEnding::DataFailed(const Job& job, const Error& error, const std::stop_token& stop) {
  const bool stored =
      StoreSurely(job, stop, [&] { return jobs_.Fail(job.id, job.run, error, NowMs()); });
  if (!stored) return;
  CountJobEnd("failed", std::string(error.kind));
  Log(LogLevel::kWarning, "job failed",
      {{"job_id", job.id}, {"code", error.kind}, {"error", error.message}});
}

void RunEnding::Postpone(const Job& job, const Error& error, const std::stop_token& stop) {
  const std::int64_t delay = RandomDelay(kFirstRetryDelay, kLongestRetryDelay, job.retries).count();
  Log(LogLevel::kWarning, "the machine is at fault: the job runs again later",
      {{"job_id", job.id}, {"code", error.kind}, {"error", error.message}, {"delay_ms", delay}});
  StoreSurely(job, stop, [&] { return jobs_.Postpone(job.id, job.run, delay, NowMs()); });
}

bool RunEnding::StoreSurely(const Job& job, const std::stop_token& stop,
                            const std::function<Result<bool>()>& store) {
  for (;;) {
    const Result<bool> stored = store();
    if (stored) return *stored;
    Log(LogLevel::kError, "cannot store how a job ended",
        {{"job_id", job.id}, {"error", stored.error().message}});
    if (stop.stop_requested()) return false;
    Pause(kRetryInterval, stop);
  }
}

}  // namespace farhorizon

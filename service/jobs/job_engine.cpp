#include "service/jobs/job_engine.h"

#include <optional>

#include "core/pipeline/progress_plan.h"
#include "service/clock.h"
#include "service/log.h"

namespace farhorizon {

namespace {

// Jobs that were postponed come of age without anybody's call.
constexpr std::chrono::milliseconds kRetryInterval{1000};

}  // namespace

JobEngine::JobEngine(JobStore& jobs, JobRunner& runner, const EngineLimits& limits)
    : jobs_(jobs), runner_(runner), memory_bytes_(limits.memory_bytes) {
  for (int i = 0; i < limits.slots; ++i) slots_.emplace_back([this] { RunSlot(); });
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

Result<std::optional<Job>> JobEngine::Claim() {
  const std::lock_guard one_at_a_time(claim_);
  MemoryRoom room{0, runner_.MostMemory()};
  {
    const std::lock_guard lock(mutex_);
    room.free_bytes = memory_bytes_ - taken_bytes_;
  }
  Result<std::optional<Job>> job = jobs_.ClaimNext(NowMs(), room);
  if (job && *job) {
    const std::lock_guard lock(mutex_);
    taken_bytes_ += runner_.MemoryOf(**job);
  }
  return job;
}

void JobEngine::RunSlot() {
  std::unique_lock lock(mutex_);
  std::uint64_t seen = 0;
  while (taking_) {
    seen = wakes_;
    ++busy_;
    lock.unlock();
    Result<std::optional<Job>> job = Claim();
    std::stop_source stop;
    lock.lock();
    if (job && *job) {
      running_[(*job)->id] = stop;
      if (stopping_) stop.request_stop();
      lock.unlock();
      runner_.Run(**job, stop.get_token());
      lock.lock();
      running_.erase((*job)->id);
      taken_bytes_ -= runner_.MemoryOf(**job);
      ++wakes_;  // one that needs its memory, or must run alone, may be waiting for its end
    }
    --busy_;
    changed_.notify_all();
    if (job && *job) continue;
    if (!job) Log(LogLevel::kError, "cannot take a job", {{"error", job.error().message}});
    changed_.wait_for(lock, kRetryInterval, [&] { return !taking_ || wakes_ != seen; });
  }
}

}  // namespace farhorizon

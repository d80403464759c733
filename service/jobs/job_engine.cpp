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

JobEngine::JobEngine(JobStore& jobs, JobRunner& runner, int slots) : jobs_(jobs), runner_(runner) {
  for (int i = 0; i < slots; ++i) slots_.emplace_back([this] { RunSlot(); });
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
      runner_.Run(**job, stop.get_token());
      lock.lock();
      running_.erase((*job)->id);
      ++wakes_;  // one that must run alone may be waiting for this one's end
    }
    --busy_;
    changed_.notify_all();
    if (job && *job) continue;
    if (!job) Log(LogLevel::kError, "cannot take a job", {{"error", job.error().message}});
    changed_.wait_for(lock, kRetryInterval, [&] { return !taking_ || wakes_ != seen; });
  }
}

}  // namespace farhorizon

#include "service/jobs/job_engine.h"

#include <optional>
#include <set>

#include "core/pipeline/progress_plan.h"
#include "service/clock.h"
#include "service/log.h"

namespace farhorizon {

namespace {

// Jobs that were postponed come of age without anybody's call.
constexpr std::chrono::milliseconds kRetryInterval{1000};
// Leases are made anew so often in their time: a few calls may fail.
constexpr int kHoldsOfLease = 6;

}  // namespace

JobEngine::JobEngine(JobStore& jobs, JobRunner& runner, const EngineLimits& limits)
    : jobs_(jobs), runner_(runner), memory_bytes_(limits.memory_bytes) {
  for (int i = 0; i < limits.slots; ++i) slots_.emplace_back([this] { RunSlot(); });
  const std::optional<std::chrono::milliseconds> lease = jobs_.LeaseTime();
  if (!lease) return;
  holder_ = std::thread([this, lease] { RunHolder(*lease); });
  jobs_.Listen([this](StoreNews news) { OnNews(news); });
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
  if (found != running_.end()) found->second.stop.request_stop();
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
  if (holder_.joinable()) jobs_.Listen(nullptr);
  {
    const std::lock_guard lock(mutex_);
    taking_ = false;
    stopping_ = true;
    for (auto& [id, running] : running_) running.stop.request_stop();
    changed_.notify_all();
  }
  for (std::thread& slot : slots_) slot.join();
  slots_.clear();
  if (holder_.joinable()) holder_.join();
}

void JobEngine::OnNews(StoreNews news) {
  const std::lock_guard lock(mutex_);
  if (news == StoreNews::kJobWaits) ++wakes_;
  if (news == StoreNews::kRunEnded) hold_now_ = true;
  changed_.notify_all();
}

void JobEngine::RunHolder(std::chrono::milliseconds lease) {
  std::unique_lock lock(mutex_);
  // Slots that a stop has ended still store how.
  while (!stopping_ || !running_.empty()) {
    changed_.wait_for(lock, lease / kHoldsOfLease,
                      [this] { return hold_now_ || (stopping_ && running_.empty()); });
    hold_now_ = false;
    lock.unlock();
    HoldAll(lease);
    lock.lock();
  }
}

void JobEngine::HoldAll(std::chrono::milliseconds lease) {
  const Clock::time_point now = Clock::now();
  std::vector<HeldRun> runs;
  {
    const std::lock_guard lock(mutex_);
    for (const auto& [id, running] : running_) runs.push_back({id, running.run});
  }
  if (runs.empty()) return;
  const Result<std::vector<std::string>> over = jobs_.Hold(runs);
  if (!over) Log(LogLevel::kWarning, "leases are not renewed", {{"error", over.error().message}});
  const std::set<std::string> ended =
      over ? std::set<std::string>(over->begin(), over->end()) : std::set<std::string>();
  const std::lock_guard lock(mutex_);
  for (const auto& [id, run] : runs) {
    const auto found = running_.find(id);
    if (found == running_.end() || found->second.run != run) continue;
    Running& running = found->second;
    const bool lost = over ? ended.count(id) > 0 : Clock::now() - running.held >= lease;
    if (!lost) {
      if (over) running.held = now;
      continue;
    }
    if (running.stop.request_stop()) Log(LogLevel::kInfo, "the run is over", {{"job_id", id}});
  }
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
    const Clock::time_point claimed = Clock::now();
    Result<std::optional<Job>> job = Claim();
    std::stop_source stop;
    lock.lock();
    if (job && *job) {
      running_[(*job)->id] = {stop, (*job)->run, claimed};
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

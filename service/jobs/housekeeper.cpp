#include "service/jobs/housekeeper.h"

#include <chrono>

#include "service/clock.h"
#include "service/jobs/end_mark.h"
#include "service/log.h"
#include "service/metrics.h"

namespace farhorizon {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kInterval{1000};
constexpr std::chrono::seconds kExpiryInterval{2};
// The sum of all bytes is taken over all rows.
constexpr std::chrono::seconds kSumInterval{30};
// While objects are removed, others wait that store some: where many services do it, seldom.
constexpr std::chrono::seconds kSharedCollectionInterval{20};

}  // namespace

Housekeeper::Housekeeper(Household household)
    : household_(std::move(household)), thread_([this] { Run(); }) {}

Housekeeper::~Housekeeper() { Stop(); }

void Housekeeper::Stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    changed_.notify_all();
  }
  if (thread_.joinable()) thread_.join();
}

void Housekeeper::Run() {
  std::unique_lock lock(mutex_);
  while (!stopping_) {
    lock.unlock();
    Tidy();
    lock.lock();
    changed_.wait_for(lock, kInterval, [this] { return stopping_; });
  }
}

void Housekeeper::Tidy() {
  if (!lock_lost_) {
    const Status held = household_.directory.CheckHeld();
    if (!held) {
      lock_lost_ = true;
      Log(LogLevel::kError, "no job is started any more", {{"error", held.error().message}});
      household_.on_lost_lock();
    }
  }
  // Another service may be on the folder by now.
  if (lock_lost_) return;
  FailOverdue();
  MarkRunning(household_.directory.lock.get());
  household_.reserve.Ensure();
  RecoverLost();
  RemoveExpired();
  RemoveExpiredUploads();
  CollectObjects();
}

void Housekeeper::CollectObjects() {
  const Clock::time_point now = Clock::now();
  if (now < next_collection_) return;
  if (household_.jobs.LeaseTime()) next_collection_ = now + kSharedCollectionInterval;
  Status cleared = household_.objects.RemoveUnacknowledged();
  if (cleared) cleared = household_.objects.RemoveGarbage();
  if (!cleared) Warn("objects are left", cleared.error());
}

void Housekeeper::RecoverLost() {
  const Result<std::int64_t> recovered = household_.jobs.RecoverLost(NowMs());
  if (!recovered) return Warn("jobs of lost leases are left", recovered.error());
  if (*recovered > 0)
    Log(LogLevel::kWarning, "jobs of lost leases taken up", {{"jobs", *recovered}});
}

void Housekeeper::FailOverdue() {
  const Result<std::vector<std::string>> failed = household_.jobs.FailOverdue(NowMs());
  if (!failed) return Warn("jobs past their deadline are left", failed.error());
  for (const std::string& id : *failed) {
    CountJobEnd("failed", "timeout");
    Log(LogLevel::kWarning, "job failed", {{"job_id", id}, {"code", "timeout"}});
  }
}

void Housekeeper::RemoveExpired() {
  const Clock::time_point now = Clock::now();
  if (now < next_expiry_) return;
  next_expiry_ = now + kExpiryInterval;
  Retention retention = household_.retention;
  if (now < next_sum_) retention.bytes = 0;
  for (;;) {
    const Result<std::int64_t> removed = household_.jobs.RemoveExpired(retention, NowMs());
    if (!removed && removed.error().kind == "no-space" && household_.reserve.Release()) continue;
    if (!removed) Warn("expired jobs are left", removed.error());
    if (!removed || *removed == 0) break;
    Log(LogLevel::kInfo, "jobs expired", {{"jobs", *removed}});
  }
  if (retention.bytes > 0) next_sum_ = Clock::now() + kSumInterval;
}

void Housekeeper::RemoveExpiredUploads() {
  for (;;) {
    const Result<std::int64_t> removed = household_.uploads.RemoveExpired(NowMs());
    if (!removed) return Warn("expired uploads are left", removed.error());
    if (*removed == 0) return;
    Log(LogLevel::kInfo, "uploads expired", {{"uploads", *removed}});
  }
}

void Housekeeper::Warn(const char* what, const Error& error) {
  if (last_warning_ == error.message) return;
  last_warning_ = error.message;
  Log(LogLevel::kWarning, what, {{"error", error.message}});
}

}  // namespace farhorizon

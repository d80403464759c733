#include "service/jobs/postgres_pool.h"

#include <algorithm>

#include "service/random.h"

namespace farhorizon {

namespace {

constexpr std::chrono::milliseconds kFirstRetryPause{50};
constexpr std::chrono::milliseconds kLongestRetryPause{5000};
// For a connection that others use.
constexpr std::chrono::seconds kLongestWait{5};
constexpr std::chrono::milliseconds kWatchInterval{500};

SqlFailure Unanswered(const char* why) { return {{ErrorCode::kResourceExhausted, why}}; }

// From half to all of a bound that doubles: many services do not come back at one time.
std::chrono::milliseconds PauseAfter(int failures) {
  const auto bound = std::min(kLongestRetryPause, kFirstRetryPause * (1 << std::min(failures, 10)));
  return bound / 2 + bound * RandomBytes()[0] / 512;
}

}  // namespace

PostgresPool::PostgresPool(Connect connect, int most, std::chrono::milliseconds longest)
    : connect_(std::move(connect)),
      most_(most),
      longest_(longest),
      watcher_([this] { CutOverdue(); }) {}

PostgresPool::~PostgresPool() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    changed_.notify_all();
  }
  watcher_.join();
}

PostgresPool::Watch::Watch(PostgresPool& pool, const PostgresDatabase& database)
    : pool_(pool), entry_(Clock::now() + pool.longest_, &database) {
  const std::lock_guard lock(pool_.mutex_);
  pool_.watched_.insert(entry_);
}

PostgresPool::Watch::~Watch() {
  const std::lock_guard lock(pool_.mutex_);
  pool_.watched_.erase(entry_);
}

std::unique_ptr<PostgresDatabase> PostgresPool::Take() {
  std::unique_lock lock(mutex_);
  if (!changed_.wait_for(lock, kLongestWait, [this] { return lent_ < most_; })) {
    throw Unanswered("all connections to the database of jobs are in use; try again later");
  }
  ++lent_;
  if (!idle_.empty()) {
    std::unique_ptr<PostgresDatabase> database = std::move(idle_.back());
    idle_.pop_back();
    return database;
  }
  const bool wait = Clock::now() < next_try_;
  lock.unlock();
  try {
    if (wait) throw Unanswered("the database of jobs cannot be reached; try again later");
    return Open();
  } catch (...) {
    lock.lock();
    --lent_;
    changed_.notify_all();
    throw;
  }
}

std::unique_ptr<PostgresDatabase> PostgresPool::Open() {
  try {
    std::unique_ptr<PostgresDatabase> database = connect_();
    const std::lock_guard lock(mutex_);
    failures_ = 0;
    return database;
  } catch (SqlFailure& failure) {
    failure.not_done = false;  // no use to try at once again
    const std::lock_guard lock(mutex_);
    next_try_ = Clock::now() + PauseAfter(failures_++);
    throw;
  }
}

void PostgresPool::GiveBack(std::unique_ptr<PostgresDatabase> database) {
  std::vector<std::unique_ptr<PostgresDatabase>> lost;
  const std::lock_guard lock(mutex_);
  if (database->IsOpen()) {
    idle_.push_back(std::move(database));
  } else {
    // Those that nobody uses have not seen it yet.
    lost = std::exchange(idle_, {});
    lost.push_back(std::move(database));
  }
  --lent_;
  changed_.notify_all();
}

void PostgresPool::CutOverdue() {
  std::unique_lock lock(mutex_);
  while (!stopping_) {
    const Clock::time_point now = Clock::now();
    for (auto it = watched_.begin(); it != watched_.end() && it->first <= now;) {
      it->second->Cut();
      it = watched_.erase(it);
    }
    changed_.wait_for(lock, kWatchInterval);
  }
}

}  // namespace farhorizon

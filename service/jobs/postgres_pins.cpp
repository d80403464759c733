#include "service/jobs/postgres_pins.h"

#include <cstdint>
#include <string>
#include <utility>

namespace farhorizon {

namespace {

// So long those who store objects wait for one who would like to remove some.
constexpr const char* kHaltTimeout = "SET LOCAL lock_timeout = 2000";
constexpr std::int64_t kPinLock = 1'179'142'740;

}  // namespace

class PostgresPins::Lock : public ObjectLock {
 public:
  Lock(PostgresPins& pins, const char* unlock) : pins_(pins), unlock_(unlock), loan_(pins.pool_) {
    const std::lock_guard lock(pins_.mutex_);
    const bool first = pins_.by_thread_.emplace(std::this_thread::get_id(), &loan_).second;
    Check(first, "a thread has one pin at a time");
  }
  ~Lock() override {
    {
      const std::lock_guard lock(pins_.mutex_);
      pins_.by_thread_.erase(std::this_thread::get_id());
    }
    if (!held_) return;
    try {
      Run(unlock_);
    } catch (const SqlFailure&) {
      loan_.Cut();  // ends the lock, too
    }
  }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

  // Calls a function that locks or unlocks; false where it says that it has not.
  bool Run(const char* function) {
    return loan_.Run([&](PostgresDatabase& database) {
      Statement statement(database, std::string("SELECT ") + function + "(?)");
      return statement.Bind(kPinLock).Step() && statement.Text(0) != "f";
    });
  }
  // Locks by a function; false where others have the lock.
  bool Take(const char* function) { return held_ = Run(function); }
  // Waits for the lock for as long as others may be kept waiting; false where they keep it.
  bool TakeAgainstAll() {
    try {
      held_ = loan_.Run([](PostgresDatabase& database) {
        Transaction transaction(database);
        database.Execute(kHaltTimeout);
        Statement(database, "SELECT pg_advisory_lock(?)").Bind(kPinLock).Run();
        transaction.Commit();
        return true;
      });
    } catch (const SqlFailure& failure) {
      if (!failure.no_lock) throw;
    }
    return held_;
  }

 private:
  PostgresPins& pins_;
  const char* unlock_;
  PostgresPool::Loan loan_;
  bool held_ = false;
};

PostgresPool::Loan* PostgresPins::OfThread() {
  const std::lock_guard lock(mutex_);
  const auto found = by_thread_.find(std::this_thread::get_id());
  return found == by_thread_.end() ? nullptr : found->second;
}

Result<std::unique_ptr<ObjectLock>> PostgresPins::Pin() {
  // A connection of the pool may have been lost since it was used: another one then.
  for (int tries = 1;; ++tries) {
    try {
      auto pin = std::make_unique<Lock>(*this, "pg_advisory_unlock_shared");
      pin->Take("pg_advisory_lock_shared");
      return std::unique_ptr<ObjectLock>(std::move(pin));
    } catch (SqlFailure& failure) {
      if (!failure.not_done || tries == 3) return std::move(failure.error);
    }
  }
}

Result<std::unique_ptr<ObjectLock>> PostgresPins::Halt(bool wait) {
  try {
    auto pin = std::make_unique<Lock>(*this, "pg_advisory_unlock");
    const bool held = wait ? pin->TakeAgainstAll() : pin->Take("pg_try_advisory_lock");
    if (!held) return std::unique_ptr<ObjectLock>();
    return std::unique_ptr<ObjectLock>(std::move(pin));
  } catch (SqlFailure& failure) {
    return std::move(failure.error);
  }
}

}  // namespace farhorizon

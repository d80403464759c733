#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <set>
#include <thread>
#include <utility>
#include <vector>

#include "service/jobs/postgres.h"

namespace farhorizon {

/// At most so many connections to one server, each lent to one call at a time.
///
/// A server that cannot be reached is asked again later and later, up to five seconds; calls fail
/// at once meanwhile. A connection on which a call waits for longer than the server itself would
/// let it (a server that is frozen, a network that is cut) is ended.
/// Threads: safe.
class PostgresPool {
 public:
  using Connect = std::function<std::unique_ptr<PostgresDatabase>()>;

  /// most: connections; longest: that a call may wait for the server.
  PostgresPool(Connect connect, int most, std::chrono::milliseconds longest);
  ~PostgresPool();
  PostgresPool(const PostgresPool&) = delete;
  PostgresPool& operator=(const PostgresPool&) = delete;

  /// A connection that is no other's; given back, or closed if it is lost.
  class Loan {
   public:
    /// Throws: SqlFailure where there is none to be had.
    explicit Loan(PostgresPool& pool) : pool_(pool), database_(pool.Take()) {}
    ~Loan() { pool_.GiveBack(std::move(database_)); }
    Loan(const Loan&) = delete;
    Loan& operator=(const Loan&) = delete;

    /// Runs work(connection), at most for as long as a call may take.
    template <typename Work>
    auto Run(Work work) -> decltype(work(std::declval<PostgresDatabase&>())) {
      const Watch watch(pool_, *database_);
      return work(*database_);
    }
    /// Ends the connection: it is no one's any more.
    void Cut() { database_->Cut(); }

   private:
    PostgresPool& pool_;
    std::unique_ptr<PostgresDatabase> database_;
  };

  /// Runs work(connection); again, where the connection was lost and nothing was done, over a new
  /// one.
  template <typename Work>
  auto Run(Work work) -> decltype(work(std::declval<PostgresDatabase&>())) {
    for (int tries = 1;; ++tries) {
      try {
        return Loan(*this).Run(work);
      } catch (const SqlFailure& failure) {
        if (!failure.not_done || tries == kMostTries) throw;
      }
    }
  }

 private:
  static constexpr int kMostTries = 3;
  using Clock = std::chrono::steady_clock;

  // A call that is waited for.
  class Watch {
   public:
    Watch(PostgresPool& pool, const PostgresDatabase& database);
    ~Watch();
    Watch(const Watch&) = delete;
    Watch& operator=(const Watch&) = delete;

   private:
    PostgresPool& pool_;
    std::pair<Clock::time_point, const PostgresDatabase*> entry_;
  };

  std::unique_ptr<PostgresDatabase> Take();
  void GiveBack(std::unique_ptr<PostgresDatabase> database);
  std::unique_ptr<PostgresDatabase> Open();
  void CutOverdue();

  const Connect connect_;
  const int most_;
  const std::chrono::milliseconds longest_;

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::unique_ptr<PostgresDatabase>> idle_;
  int lent_ = 0;
  int failures_ = 0;  // to connect, since the last success
  Clock::time_point next_try_;
  std::set<std::pair<Clock::time_point, const PostgresDatabase*>> watched_;
  bool stopping_ = false;
  std::thread watcher_;
};

}  // namespace farhorizon

#pragma once

#include <chrono>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>

#include "core/base/result.h"
#include "service/jobs/job_store.h"
#include "service/jobs/postgres_pool.h"

namespace farhorizon {

/// The locks of JobStore::PinObjects and HaltPins, for all processes on one server. Each is a lock
/// of the server that a connection has, not a transaction: it ends with the connection.
/// Threads: safe; a thread has one lock at a time.
class PostgresPins {
 public:
  /// As PostgresPool has it, whose connections are for locks alone.
  PostgresPins(PostgresPool::Connect connect, int most, std::chrono::milliseconds longest)
      : pool_(std::move(connect), most, longest) {}

  /// As JobStore::PinObjects has it.
  Result<std::unique_ptr<ObjectLock>> Pin();
  /// As JobStore::HaltPins has it.
  Result<std::unique_ptr<ObjectLock>> Halt(bool wait);
  /// The connection of the lock that this thread has; nullptr without one.
  PostgresPool::Loan* OfThread();

 private:
  class Lock;

  PostgresPool pool_;
  std::mutex mutex_;
  std::map<std::thread::id, PostgresPool::Loan*> by_thread_;
};

}  // namespace farhorizon

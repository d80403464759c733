#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "service/jobs/data_directory.h"
#include "service/jobs/job_store.h"
#include "service/jobs/object_collector.h"
#include "service/jobs/storage_health.h"
#include "service/jobs/upload_service.h"

namespace farhorizon {

/// What a housekeeper looks after.
struct Household {
  const DataDirectory& directory;
  JobStore& jobs;
  ObjectCollector& objects;
  UploadService& uploads;
  DiskReserve& reserve;
  Retention retention;
  std::function<void()> on_lost_lock;  ///< called once
};

/// A thread for the work that nobody waits for: ends jobs at their deadline, takes up those whose
/// lease is over, removes expired jobs and uploads and what they have left, keeps the reserve and
/// watches the lock. Of services that share a store, each does it.
class Housekeeper {
 public:
  /// Requires: what `household` refers to outlives this object.
  explicit Housekeeper(Household household);
  ~Housekeeper();
  Housekeeper(const Housekeeper&) = delete;
  Housekeeper& operator=(const Housekeeper&) = delete;

  /// Ends the thread. The last call.
  void Stop();

 private:
  void Run();
  void Tidy();
  void FailOverdue();
  void RecoverLost();
  void CollectObjects();
  void RemoveExpired();
  void RemoveExpiredUploads();
  /// Logs a failure, unless it is the one that was logged last.
  void Warn(const char* what, const Error& error);

  Household household_;
  bool lock_lost_ = false;
  std::string last_warning_;
  std::chrono::steady_clock::time_point next_expiry_;
  std::chrono::steady_clock::time_point next_sum_;
  std::chrono::steady_clock::time_point next_collection_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace farhorizon

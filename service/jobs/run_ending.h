#pragma once

#include <functional>
#include <stop_token>

#include "core/base/result.h"
#include "service/jobs/job_store.h"
#include "service/jobs/storage_health.h"

namespace farhorizon {

/// Stores how a run of a job has ended: by whose fault decides whether it runs again.
///
///   the data's                    failed, at once
///   the worker's (it crashed)     run once more, then failed
///   the machine's (disk, memory)  run again, later and later; never failed
/// Threads: safe.
class RunEnding {
 public:
  /// Requires: store and health outlive this object.
  RunEnding(JobStore& jobs, StorageHealth& health) : jobs_(jobs), health_(health) {}

  /// A job that no run could bring to another end.
  void DataFailed(const Job& job, const Error& error, const std::stop_token& stop);
  /// A run that has ended with an error before or after its worker ran.
  void Failed(const Job& job, const Error& error, const std::stop_token& stop);
  /// A run whose worker has told an error. A machine's fault that this process cannot see is
  /// believed a few times.
  void WorkerFailed(const Job& job, const Error& error, const std::stop_token& stop);
  /// A run whose worker died or was killed. Any crash on a disk that is full or fails is the
  /// machine's fault.
  void WorkerCrashed(const Job& job, const Error& error, const std::stop_token& stop);
  /// A run that `memory_bytes` are expected to suffice for, which were not expected before.
  void ShortOfMemory(const Job& job, std::int64_t memory_bytes, const std::stop_token& stop);
  /// A run that a stop has ended: its job was dismissed, or the service is being stopped.
  void Stopped(const Job& job, const std::stop_token& stop);

 private:
  void Postpone(const Job& job, const Error& error, const std::stop_token& stop);
  /// Calls `store` until it succeeds, at most until a stop is requested: then the job stays
  /// running in the store, and RecoverRunning makes it accepted at the next start.
  bool StoreSurely(const Job& job, const std::stop_token& stop,
                   const std::function<Result<bool>()>& store);

  JobStore& jobs_;
  StorageHealth& health_;
};

}  // namespace farhorizon

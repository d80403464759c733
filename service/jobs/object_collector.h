#pragma once

#include <mutex>
#include <shared_mutex>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "service/jobs/job_store.h"
#include "service/jobs/object_store.h"

namespace farhorizon {

/// Garbage collection of objects: an object is removed once no row of the job store references it,
/// and never while a row that references it is about to be committed.
/// Threads: safe.
class ObjectCollector {
 public:
  ObjectCollector(JobStore& jobs, ObjectStore& objects) : jobs_(jobs), objects_(objects) {}

  /// No object is removed while the lock is held: put objects and commit the rows that reference
  /// them under one lock.
  [[nodiscard]] std::shared_lock<std::shared_mutex> Pin() { return std::shared_lock(mutex_); }

  /// Removes those of the objects `names` that no row references. Requires: the caller holds no
  /// lock of Pin.
  Status RemoveUnreferenced(const std::vector<std::string>& names);
  /// The same for every stored object: at start, for those that a killed process left.
  Status RemoveAllUnreferenced();

 private:
  JobStore& jobs_;
  ObjectStore& objects_;
  std::shared_mutex mutex_;
};

}  // namespace farhorizon

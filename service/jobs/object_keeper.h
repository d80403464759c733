#pragma once

#include <mutex>
#include <shared_mutex>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "service/jobs/job_store.h"
#include "service/jobs/object_store.h"

namespace farhorizon {

/// Keeps objects and the rows that name them in step: no row without its object, and no object
/// longer than a row names it.
/// Threads: safe.
class ObjectKeeper {
 public:
  ObjectKeeper(JobStore& jobs, ObjectStore& objects) : jobs_(jobs), objects_(objects) {}

  /// While this is held nothing is removed: put objects, then commit the rows that name them.
  [[nodiscard]] std::shared_lock<std::shared_mutex> Hold() { return std::shared_lock(mutex_); }

  /// Removes those of `names` that no row names. Requires: the caller holds nothing.
  Status RemoveUnnamed(const std::vector<std::string>& names);
  /// The same for all there are: at start, for what a killed process left.
  Status RemoveAllUnnamed();

 private:
  JobStore& jobs_;
  ObjectStore& objects_;
  std::shared_mutex mutex_;
};

}  // namespace farhorizon

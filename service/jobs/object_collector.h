#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "service/jobs/job_store.h"
#include "service/jobs/object_store.h"

namespace farhorizon {

/// What SortOut has found.
struct SortedObjects {
  std::int64_t strays = 0;      ///< set aside: no row knows them, and none of this store had them
  std::int64_t taken_back = 0;  ///< strays of earlier that a row knows again
};

/// Garbage collection of objects: an object is removed once no row of the job store references it,
/// and never while a row that references it is about to be committed. Only objects that this store
/// itself had are ever removed: those of removed jobs, and incoming ones without a row.
/// Threads: safe.
class ObjectCollector {
 public:
  ObjectCollector(JobStore& jobs, ObjectStore& objects) : jobs_(jobs), objects_(objects) {}

  /// As JobStore::PinObjects has it.
  [[nodiscard]] Result<std::unique_ptr<ObjectLock>> Pin() { return jobs_.PinObjects(); }

  /// Removes those of the objects `names` that no row references. Requires: they are incoming ones,
  /// or of removed jobs; the caller holds no lock of Pin. Those that others pin for too long are
  /// left to RemoveUnacknowledged and RemoveGarbage.
  Status RemoveUnreferenced(const std::vector<std::string>& names);
  /// The same without a wait for locks of Pin, of which one is held while large results are copied:
  /// then the objects are left to the next RemoveUnacknowledged and RemoveGarbage.
  /// Requires: they are incoming ones, or of removed jobs.
  Status RemoveUnlessPinned(const std::vector<std::string>& names);
  /// Removes incoming objects that no row has come to name, of submissions and runs that failed,
  /// and keeps the others: those of a process that was killed between a row and Keep.
  Status RemoveUnacknowledged();
  /// Removes what is left of the objects of removed jobs.
  Status RemoveGarbage();
  /// Brings the objects into order with the rows, for the start of a service: removes garbage and
  /// incoming objects without a row, sets strays aside and takes strays back that a row knows.
  /// Requires: no other process uses the stores.
  Result<SortedObjects> SortOut();

 private:
  /// Requires: a lock of JobStore::HaltPins is held.
  Status RemoveEach(const std::vector<std::string>& names);
  Status RemoveUnder(const Result<std::unique_ptr<ObjectLock>>& halt,
                     const std::vector<std::string>& names);
  /// Those of the objects in a list that a row references, or that none does.
  Result<std::vector<std::string>> Select(ObjectList which, bool referenced);

  JobStore& jobs_;
  ObjectStore& objects_;
};

}  // namespace farhorizon

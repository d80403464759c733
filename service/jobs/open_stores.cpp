#include "service/jobs/open_stores.h"

#include <utility>

#include "service/jobs/local_object_store.h"
#include "service/jobs/sqlite_job_store.h"
#include "service/jobs/store_identity.h"
#include "service/log.h"

namespace farhorizon {

Result<Stores> OpenStores(const DataDirectory& directory) {
  Status there = CheckDatabaseIsThere(directory);
  if (!there) return std::move(there.error());
  Result<std::unique_ptr<JobStore>> jobs = OpenSqliteJobStore(directory.Jobs());
  if (!jobs) return std::move(jobs.error());
  Result<std::unique_ptr<ObjectStore>> objects = OpenLocalObjectStore(directory.Objects());
  if (!objects) return std::move(objects.error());
  Status same = CheckSameStore(directory, **jobs, **objects);
  if (!same) return std::move(same.error());
  Result<StoreIdentity> identity = (*jobs)->BeginGeneration();
  Status written = identity ? WriteIdentity(directory, *identity) : Status(identity.error());
  if (!written) {
    Log(LogLevel::kWarning, "the start is not counted", {{"error", written.error().message}});
  }
  return Stores{*std::move(jobs), *std::move(objects)};
}

}  // namespace farhorizon

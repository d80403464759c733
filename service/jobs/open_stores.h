#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "core/base/result.h"
#include "service/jobs/data_directory.h"
#include "service/jobs/job_store.h"
#include "service/jobs/object_store.h"

namespace farhorizon {

/// Where jobs and objects are kept. Either both are in the data directory, or both are shared with
/// other services.
struct StoreOptions {
  std::string jobs;               ///< the URL of a PostgreSQL database; empty: the data directory
  std::filesystem::path objects;  ///< a folder; empty: the data directory
  std::int64_t lease_seconds = 30;
  int connections = 6;
};

/// The two stores of a service.
struct Stores {
  std::unique_ptr<JobStore> jobs;
  std::unique_ptr<ObjectStore> objects;
};

/// Succeeds unless one store is shared and the other is not. Errors: kInvalidArgument
///   "invalid-config".
Status CheckStoreOptions(const StoreOptions& options);

/// Opens database and objects, which must belong together, and counts the start.
/// Errors: kIo "job-store-unusable", with the remedy; then nothing was removed or made; those of
///   CheckStoreOptions.
Result<Stores> OpenStores(DataDirectory& directory, const StoreOptions& options = {});

}  // namespace farhorizon

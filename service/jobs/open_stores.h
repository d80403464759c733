#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "core/base/result.h"
#include "service/jobs/data_directory.h"
#include "service/jobs/job_store.h"
#include "service/jobs/object_store.h"
#include "service/s3/s3_location.h"

namespace farhorizon {

/// Where jobs and objects are kept. Either both are in the data directory, or both are shared with
/// other services.
struct StoreOptions {
  std::string jobs;  ///< the URL of a PostgreSQL database; empty: the data directory
  /// A folder, or s3://BUCKET[/PREFIX]; empty: the data directory.
  std::string objects;
  std::int64_t lease_seconds = 30;
  int connections = 6;
  S3Options s3;
  /// Of copies of a bucket's objects in the data directory.
  std::int64_t cache_bytes = std::int64_t{4} << 30U;
};

/// The two stores of a service.
struct Stores {
  std::unique_ptr<JobStore> jobs;
  std::unique_ptr<ObjectStore> objects;
};

/// Succeeds unless one store is shared and the other is not, the URL of either cannot be read, no
/// keys of a bucket are given, or the folder of objects is the data directory.
/// Errors: kInvalidArgument "invalid-config".
Status CheckStoreOptions(const StoreOptions& options, const std::filesystem::path& data);

/// Opens database and objects, which must belong together, and counts the start.
/// least_free_bytes: room that copies of objects leave on the disk of the data directory.
/// Errors: kIo "job-store-unusable", with the remedy; then nothing was removed or made; those of
///   CheckStoreOptions.
Result<Stores> OpenStores(const DataDirectory& directory, const StoreOptions& options = {},
                          std::int64_t least_free_bytes = 0);

}  // namespace farhorizon

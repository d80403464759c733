#pragma once

#include <memory>

#include "core/base/result.h"
#include "service/jobs/data_directory.h"
#include "service/jobs/job_store.h"
#include "service/jobs/object_store.h"

namespace farhorizon {

/// The two stores of a data directory.
struct Stores {
  std::unique_ptr<JobStore> jobs;
  std::unique_ptr<ObjectStore> objects;
};

/// Opens database and objects, which must belong together, and counts the start.
/// Errors: kIo "job-store-unusable", with the remedy; then nothing was removed or made.
Result<Stores> OpenStores(const DataDirectory& directory);

}  // namespace farhorizon

#pragma once

#include <filesystem>
#include <memory>

#include "core/base/result.h"
#include "service/jobs/job_store.h"

namespace farhorizon {

/// Jobs in one SQLite file: write-ahead log, synchronous=FULL, one connection under a mutex.
///
/// Opens the file, or makes it if it is missing; brings an older schema forward and checks the
/// pages. A file that cannot be read is left as it is.
/// Errors: kIo, with the remedy: the file is no job store of farhorizon, is damaged, or comes from
///   a newer version.
Result<std::unique_ptr<JobStore>> OpenSqliteJobStore(const std::filesystem::path& path);

}  // namespace farhorizon

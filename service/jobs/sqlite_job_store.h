#pragma once

#include <filesystem>
#include <memory>

#include "core/base/result.h"
#include "service/jobs/job_store.h"

namespace farhorizon {

/// Jobs in one SQLite file: WAL, synchronous=FULL, one connection under a mutex.
///
/// Opens the file or makes it, brings an older schema forward and checks it (quick_check).
/// Errors: kIo, saying what to do: the file is no job store of ours, is damaged, or comes from a
///   newer version. Nothing is ever started empty over a file that cannot be read.
Result<std::unique_ptr<JobStore>> OpenSqliteJobStore(const std::filesystem::path& path);

}  // namespace farhorizon

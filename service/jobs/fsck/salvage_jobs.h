#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace farhorizon {

/// What is wrong with the pages of a database of jobs, as SQLite says it; empty where nothing is.
std::vector<std::string> ComplaintsOf(const std::filesystem::path& database);

/// The version of its schema; 0 where it cannot be read.
std::int64_t SchemaVersionOf(const std::filesystem::path& database);

/// Copies every row of `damaged` that can be read into the new database `fresh`; the number of
/// jobs. One row that cannot be read hides no other.
/// Errors: kIo where not even the tables can be told.
Result<std::int64_t> SalvageJobs(const std::filesystem::path& damaged,
                                 const std::filesystem::path& fresh);

}  // namespace farhorizon

#pragma once

#include "service/jobs/job.h"
#include "service/jobs/sqlite.h"

namespace farhorizon {

/// The columns of the table `jobs` that ReadJob expects, in its order, for SELECT and RETURNING.
extern const char* const kJobColumns;

/// The job of the current row of a statement that selects kJobColumns.
Job ReadJob(const Statement& row);

/// The job with this id; nullopt without one.
std::optional<Job> SelectJob(const Database& database, const std::string& id);

}  // namespace farhorizon

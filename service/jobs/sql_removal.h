#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "service/jobs/job_store.h"
#include "service/jobs/sql.h"

namespace farhorizon {

/// As JobStore::Dismiss has it.
Result<Job> DismissJob(SqlDatabase& database, const std::string& id, std::int64_t now_ms);
/// Removes the rows of the job's artifacts; their objects become garbage.
void RemoveArtifacts(const SqlDatabase& database, const std::string& id);
/// As JobStore::RemoveExpired has it.
std::int64_t RemoveExpiredJobs(SqlDatabase& database, const Retention& retention,
                               std::int64_t now_ms);
/// As the calls of these names of JobStore have it.
bool IsReferenced(const SqlDatabase& database, const std::string& sha256);
std::vector<std::string> SelectGarbage(const SqlDatabase& database);
void ForgetGarbage(SqlDatabase& database, const std::vector<std::string>& names);

}  // namespace farhorizon

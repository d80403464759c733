#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "service/jobs/job_store.h"
#include "service/jobs/sql.h"

namespace farhorizon {

/// As JobStore::Hold has it, by the server's clock. Requires: within a transaction.
std::vector<std::string> HoldRuns(const SqlDatabase& database, const std::vector<HeldRun>& runs);
/// As JobStore::RecoverLost has it.
std::int64_t RecoverLostJobs(SqlDatabase& database, std::int64_t now_ms);

}  // namespace farhorizon

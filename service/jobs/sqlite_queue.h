#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "service/jobs/job_store.h"
#include "service/jobs/sqlite.h"

namespace farhorizon {

/// As JobStore::CheckQueue has it.
Status CheckQueue(const Database& database, const std::string& client, const QueueBounds& bounds);
/// As JobStore::CountUnfinished has it.
UnfinishedJobs CountQueue(const Database& database);
/// As JobStore::Insert has it. Requires: within a transaction.
Result<Job> InsertInQueue(const Database& database, const NewJob& job, const QueueBounds& bounds,
                          std::int64_t now_ms);
/// As JobStore::FailOverdue has it.
std::vector<std::string> FailOverdueJobs(Database& database, std::int64_t now_ms);
/// As JobStore::RecoverRunning has it.
std::int64_t RecoverJobs(Database& database, PreviousEnd end, std::int64_t now_ms);

}  // namespace farhorizon

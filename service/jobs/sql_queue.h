#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "service/jobs/job_store.h"
#include "service/jobs/sql.h"

namespace farhorizon {

/// Nobody else inserts a job or an upload until the transaction ends.
void LockQueue(const SqlDatabase& database);

/// As JobStore::CheckQueue has it.
Status CheckQueue(const SqlDatabase& database, const std::string& client,
                  const QueueBounds& bounds);
/// As JobStore::FindEarlier has it.
Result<std::optional<Job>> FindEarlierJob(const SqlDatabase& database, const NewJob& job,
                                          std::int64_t now_ms);
/// As JobStore::Insert has it. Requires: within a transaction.
Result<Job> InsertInQueue(const SqlDatabase& database, const NewJob& job, const QueueBounds& bounds,
                          std::int64_t now_ms);
/// As JobStore::FailOverdue has it.
std::vector<std::string> FailOverdueJobs(SqlDatabase& database, std::int64_t now_ms);
/// As JobStore::RecoverRunning has it.
std::int64_t RecoverJobs(SqlDatabase& database, PreviousEnd end, std::int64_t now_ms);

}  // namespace farhorizon

#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "service/jobs/job_store.h"
#include "service/jobs/sql.h"

namespace farhorizon {

/// A run of a job, at a time.
struct RunAt {
  const std::string& id;
  std::int64_t run = 0;
  std::int64_t now_ms = 0;
};

/// The calls of JobStore on a running job. Each returns false, and changes nothing, where the run
/// is not the job's current one.
bool StoreProgress(const SqlDatabase& database, const RunAt& at, int progress,
                   const std::string& message);
bool StoreAssumptions(const SqlDatabase& database, const RunAt& at, const Assumptions& assumptions);
bool PublishRun(SqlDatabase& database, const RunAt& at, const std::vector<Artifact>& artifacts,
                const std::map<std::string, double>& timings);
bool FailRun(const SqlDatabase& database, const RunAt& at, const Error& failure);
bool RequeueRun(const SqlDatabase& database, const RunAt& at, RequeueReason reason);
/// As JobStore::RequeueWithMemory has it.
bool RequeueWithMemory(const SqlDatabase& database, const RunAt& at, std::int64_t memory_bytes);
bool PostponeRun(const SqlDatabase& database, const RunAt& at, std::int64_t delay_ms);

}  // namespace farhorizon

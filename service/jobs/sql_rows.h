#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "service/jobs/job.h"
#include "service/jobs/job_store.h"
#include "service/jobs/sql.h"

namespace farhorizon {

/// The columns of the table `jobs`, in the order in which ReadJob reads them, for SELECT and
/// RETURNING.
inline constexpr const char* kJobColumns =
    "id, state, filename, parameters, input_sha256, input_bytes, progress, message, created_ms, "
    "started_ms, finished_ms, updated_ms, attempt, crash_count, failure_code, failure_kind, "
    "failure_message, timings, assumptions, client, run, retries, priority, deadline_ms, "
    "timeout_seconds, cost_memory_bytes, cost_seconds, process, answer, owner, source";

/// Assumptions as the column has them: a JSON array of objects with a code and a text.
std::string AssumptionsColumn(const Assumptions& assumptions);

/// The job of the current row of a statement that selects kJobColumns. Reads every row: one with a
/// value that cannot be understood, and that the job's run or its end depends on, has a failure.
Job ReadJob(const Statement& row);

/// The job with this id; nullopt without one.
std::optional<Job> SelectJob(const SqlDatabase& database, const std::string& id);
/// The same for a transaction that is about to change it: nobody else does until its end.
std::optional<Job> SelectJobToChange(const SqlDatabase& database, const std::string& id);
/// As JobStore::List has it.
JobPage SelectPage(const SqlDatabase& database, const JobQuery& query);
/// As JobStore::CountUnfinished has it.
UnfinishedJobs CountUnfinishedJobs(const SqlDatabase& database);
/// Inserts an accepted job; its id is greater than all others.
std::string InsertJob(const SqlDatabase& database, const NewJob& job, std::int64_t now_ms);

/// The condition of jobs that run in this process.
std::string RunningHere(const SqlDatabase& database);
/// For an UPDATE of jobs: what makes one failed. BindFailure binds its parameters.
inline constexpr const char* kSetFailed =
    "state = 'failed', message = ?, failure_code = ?, failure_kind = ?, failure_message = ?, "
    "finished_ms = ?";
Statement& BindFailure(Statement& update, const Error& failure, std::int64_t now_ms);

/// As JobStore::Identity has it.
StoreIdentity SelectIdentity(const SqlDatabase& database);

/// The artifacts of a job, by name.
std::vector<Artifact> SelectArtifacts(const SqlDatabase& database, const std::string& id);
void InsertArtifact(const SqlDatabase& database, const std::string& id, const Artifact& artifact);

}  // namespace farhorizon

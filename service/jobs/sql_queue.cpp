// Jobs on their way in, and out without a run: the bound of the queue, deadlines, and what happens
// to those that ran when a process ended.
#include "service/jobs/sql_queue.h"

#include "service/jobs/sql_callbacks.h"
#include "service/jobs/sql_rows.h"

namespace farhorizon {

namespace {

// How long a client may wait before it sends a submission again
// (draft-ietf-httpapi-idempotency-key-header).
constexpr std::int64_t kIdempotencyKeepMs = std::int64_t{7} * 24 * 3600 * 1000;
// A process that crashed may have crashed for another reason, once or twice.
constexpr std::int64_t kMostCrashes = 3;
// Ends from without are no fault of a job's. But a job that kills the process, whatever the way,
// is stopped after an hour or two of a supervisor that starts the service again every few seconds.
constexpr std::int64_t kMostAttempts = 1000;

bool HasTerms(const Job& job, const JobTerms& terms) {
  const std::int64_t deadline = job.deadline_ms.value_or(job.created_ms) - job.created_ms;
  return job.priority == terms.priority && job.timeout_seconds == terms.timeout_seconds &&
         deadline == terms.deadline_seconds * 1000;
}

bool HasInput(const Job& earlier, const NewJob& job) {
  return earlier.source == job.source &&
         (!job.source.empty() || earlier.input_sha256 == job.input_sha256);
}

// The job `id`, which an earlier submission with the idempotency key of `job` has made.
Result<Job> EarlierJob(const SqlDatabase& database, const std::string& id, const NewJob& job) {
  const std::optional<Job> earlier = SelectJob(database, id);
  if (earlier && HasInput(*earlier, job) && earlier->filename == job.filename &&
      earlier->parameters == job.parameters && HasTerms(*earlier, job.terms) &&
      earlier->process == job.process && earlier->answer == job.answer &&
      SelectSubscriber(database, id) == job.subscriber) {
    return *earlier;
  }
  return Error{ErrorCode::kInvalidArgument,
               "this Idempotency-Key came with another DEM or other parameters before; "
               "send a new key with a new job",
               "idempotency-key-reused"};
}

Error Full(std::int64_t waiting, const std::string& whose, ErrorKind kind) {
  return {
      ErrorCode::kResourceExhausted,
      std::to_string(waiting) + " jobs" + whose + " are waiting, as many as may; try again later",
      kind};
}

}  // namespace

void LockQueue(const SqlDatabase& database) {
  const std::string& lock = database.dialect().lock_queue;
  if (!lock.empty()) Statement(database, lock).Run();
}

Status CheckQueue(const SqlDatabase& database, const std::string& client,
                  const QueueBounds& bounds) {
  Statement own(database, "SELECT count(*) FROM jobs WHERE state = 'accepted' AND client = ?");
  own.Bind(client).Step();
  if (own.Integer(0) >= bounds.of_client && bounds.of_client < bounds.all) {
    return Full(own.Integer(0), " of yours", "too-many-jobs");
  }
  Statement all(database, "SELECT count(*) FROM jobs WHERE state = 'accepted'");
  all.Step();
  if (all.Integer(0) >= bounds.all) return Full(all.Integer(0), "", "queue-full");
  return Ok{};
}

Result<std::optional<Job>> FindEarlierJob(const SqlDatabase& database, const NewJob& job,
                                          std::int64_t now_ms) {
  if (!job.idempotency_key) return std::optional<Job>();
  Statement known(database,
                  "SELECT job_id FROM idempotency_keys WHERE owner = ? AND key = ? AND "
                  "created_ms >= ?");
  known.Bind(job.owner).Bind(*job.idempotency_key).Bind(now_ms - kIdempotencyKeepMs);
  if (!known.Step()) return std::optional<Job>();
  Result<Job> earlier = EarlierJob(database, known.Text(0), job);
  if (!earlier) return std::move(earlier.error());
  return std::optional<Job>(*std::move(earlier));
}

Result<Job> InsertInQueue(const SqlDatabase& database, const NewJob& job, const QueueBounds& bounds,
                          std::int64_t now_ms) {
  if (job.idempotency_key) {
    Statement(database, "DELETE FROM idempotency_keys WHERE created_ms < ?")
        .Bind(now_ms - kIdempotencyKeepMs)
        .Run();
  }
  Result<std::optional<Job>> earlier = FindEarlierJob(database, job, now_ms);
  if (!earlier) return std::move(earlier.error());
  if (*earlier) return **std::move(earlier);
  Status room = CheckQueue(database, job.client, bounds);
  if (!room) return std::move(room.error());
  const std::string id = InsertJob(database, job, now_ms);
  InsertSubscriber(database, id, job.subscriber);
  if (job.idempotency_key) {
    Statement key(database,
                  "INSERT INTO idempotency_keys (owner, key, job_id, created_ms) "
                  "VALUES (?, ?, ?, ?)");
    key.Bind(job.owner).Bind(*job.idempotency_key).Bind(id).Bind(now_ms).Run();
  }
  std::optional<Job> stored = SelectJob(database, id);
  Check(stored.has_value(), "an inserted job is there");
  return *std::move(stored);
}

std::vector<std::string> FailOverdueJobs(SqlDatabase& database, std::int64_t now_ms) {
  // Without a transaction where there is nothing to do, as nearly always.
  if (!Statement(database, "SELECT 1 FROM jobs WHERE state = 'accepted' AND deadline_ms <= ?")
           .Bind(now_ms)
           .Step()) {
    return {};
  }
  constexpr const char* kMessage =
      "'the job was not done within the ' || ((deadline_ms - created_ms) / 1000) || "
      "' seconds of its deadline, for it had to wait; send it again with a later one'";
  Transaction transaction(database);
  Statement fail(database, std::string("UPDATE jobs SET state = 'failed', message = ") + kMessage +
                               ", failure_message = " + kMessage +
                               ", failure_code = ?, failure_kind = ?, finished_ms = ?, "
                               "updated_ms = ? WHERE state = 'accepted' AND deadline_ms <= ? "
                               "RETURNING id");
  fail.Bind(std::string(ErrorCodeName(ErrorCode::kResourceExhausted)));
  fail.Bind(std::string(ErrorKind("timeout"))).Bind(now_ms).Bind(now_ms).Bind(now_ms);
  std::vector<std::string> ids;
  while (fail.Step()) ids.push_back(fail.Text(0));
  transaction.Commit();
  return ids;
}

std::int64_t RecoverJobs(SqlDatabase& database, PreviousEnd end, std::int64_t now_ms) {
  Transaction transaction(database);
  // That these jobs ran was stored before their work began. So a crash counts even where the
  // process could not do anything more.
  Statement poison(database, std::string("UPDATE jobs SET ") + kSetFailed +
                                 ", updated_ms = ? WHERE (crashes + ? >= ? OR attempt >= ?) AND " +
                                 RunningHere(database));
  const Error failure = {ErrorCode::kIo,
                         "the service died again and again while this job ran; the fault is ours, "
                         "the DEM that shows it is worth a report",
                         "poison-job"};
  BindFailure(poison, failure, now_ms).Bind(now_ms);
  poison.Bind(std::int64_t{end == PreviousEnd::kCrashed ? 1 : 0}).Bind(kMostCrashes);
  poison.Bind(kMostAttempts).Run();
  Statement again(database,
                  "UPDATE jobs SET state = 'accepted', message = 'waiting to run again', "
                  "crashes = crashes + ?, attempt = attempt - ?, updated_ms = ? WHERE " +
                      RunningHere(database));
  again.Bind(std::int64_t{end == PreviousEnd::kCrashed ? 1 : 0});
  again.Bind(std::int64_t{end == PreviousEnd::kOrderly ? 1 : 0}).Bind(now_ms);
  const std::int64_t count = again.Run();
  transaction.Commit();
  return count;
}

}  // namespace farhorizon

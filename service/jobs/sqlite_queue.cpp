// Jobs on their way in and to their turn: the bound of the queue, the fair share, and what happens
// to those that ran when a process ended.
#include "service/jobs/sqlite_queue.h"

#include <algorithm>
#include <tuple>
#include <vector>

#include "service/jobs/sqlite_rows.h"

namespace farhorizon {

namespace {

// How long a client may wait before it sends a submission again
// (draft-ietf-httpapi-idempotency-key-header).
constexpr std::int64_t kIdempotencyKeepMs = std::int64_t{7} * 24 * 3600 * 1000;
// No job is postponed for longer: a later time was written before the clock went back.
constexpr std::int64_t kLongestDelayMs = std::int64_t{3600} * 1000;
// A process that crashed may have crashed for another reason, once or twice.
constexpr std::int64_t kMostCrashes = 3;
// Ends from without are no fault of a job's. But a job that kills the process, whatever the way,
// is stopped after an hour or two of a supervisor that starts the service again every few seconds.
constexpr std::int64_t kMostAttempts = 1000;
// Beyond as many clients, those that are forgotten were served long ago.
constexpr std::size_t kMostClients = 10'000;

// A client with accepted jobs.
struct WaitingClient {
  std::int64_t running = 0;
  std::int64_t last_served = 0;
  std::string oldest;  // the id of its oldest job
  std::string name;
};

std::int64_t RunningOf(const Database& database, const std::string& client) {
  Statement count(database, "SELECT count(*) FROM jobs WHERE state = 'running' AND client = ?");
  count.Bind(client).Step();
  return count.Integer(0);
}

// The clients that wait, in the order in which they are to be served. The statement steps from
// client to client in the index jobs_by_client, whatever the number of jobs.
std::vector<WaitingClient> WaitingClients(const Database& database, const ClientTurns& turns) {
  Statement clients(database,
                    "WITH RECURSIVE waiting(client) AS ("
                    "SELECT min(client) FROM jobs WHERE state = 'accepted' UNION ALL "
                    "SELECT (SELECT min(client) FROM jobs WHERE state = 'accepted' AND "
                    "client > waiting.client) FROM waiting WHERE client IS NOT NULL) "
                    "SELECT client, (SELECT min(id) FROM jobs WHERE state = 'accepted' AND "
                    "jobs.client = waiting.client) FROM waiting WHERE client IS NOT NULL");
  std::vector<WaitingClient> found;
  while (clients.Step()) {
    const std::string name = clients.Text(0);
    found.push_back({RunningOf(database, name), turns.LastOf(name), clients.Text(1), name});
  }
  std::sort(found.begin(), found.end(), [](const WaitingClient& a, const WaitingClient& b) {
    return std::tie(a.running, a.last_served, a.oldest) <
           std::tie(b.running, b.last_served, b.oldest);
  });
  return found;
}

bool Any(const Database& database, const char* condition) {
  return Statement(database, std::string("SELECT 1 FROM jobs WHERE ") + condition + " LIMIT 1")
      .Step();
}

// The oldest job of the client that may be started, and whether it must run alone.
struct Candidate {
  std::string id;
  bool alone = false;
};
std::optional<Candidate> CandidateOf(const Database& database, const std::string& client,
                                     std::int64_t now_ms) {
  Statement oldest(database,
                   "SELECT id, crashes FROM jobs WHERE state = 'accepted' AND client = ? AND "
                   "(not_before_ms <= ? OR not_before_ms > ?) ORDER BY id LIMIT 1");
  oldest.Bind(client).Bind(now_ms).Bind(now_ms + kLongestDelayMs);
  if (!oldest.Step()) return std::nullopt;
  return Candidate{oldest.Text(0), oldest.Integer(1) > 0};
}

std::optional<Job> Start(const Database& database, const std::string& id, std::int64_t now_ms) {
  Statement start(database,
                  std::string("UPDATE jobs SET state = 'running', run = run + 1, attempt = "
                              "attempt + 1, started_ms = coalesce(started_ms, ?), updated_ms = ?, "
                              "message = 'starting' WHERE id = ? RETURNING ") +
                      kJobColumns);
  start.Bind(now_ms).Bind(now_ms).Bind(id);
  std::optional<Job> job;
  while (start.Step()) job = ReadJob(start);
  return job;
}

// The job `id`, which an earlier submission with the idempotency key of `job` has made.
Result<Job> EarlierJob(const Database& database, const std::string& id, const NewJob& job) {
  const std::optional<Job> earlier = SelectJob(database, id);
  if (earlier && earlier->input_sha256 == job.input_sha256 && earlier->filename == job.filename &&
      earlier->parameters == job.parameters) {
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

void ClientTurns::Serve(const std::string& client) {
  if (last_.size() >= kMostClients) last_.clear();
  last_[client] = ++turns_;
}

std::int64_t ClientTurns::LastOf(const std::string& client) const {
  const auto found = last_.find(client);
  return found == last_.end() ? 0 : found->second;
}

Status CheckQueue(const Database& database, const std::string& client, const QueueBounds& bounds) {
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

Result<Job> InsertInQueue(const Database& database, const NewJob& job, const QueueBounds& bounds,
                          std::int64_t now_ms) {
  if (job.idempotency_key) {
    Statement(database, "DELETE FROM idempotency_keys WHERE created_ms < ?")
        .Bind(now_ms - kIdempotencyKeepMs)
        .Run();
    Statement known(database, "SELECT job_id FROM idempotency_keys WHERE key = ?");
    if (known.Bind(*job.idempotency_key).Step()) return EarlierJob(database, known.Text(0), job);
  }
  Status room = CheckQueue(database, job.client, bounds);
  if (!room) return std::move(room.error());
  const std::string id = InsertJob(database, job, now_ms);
  if (job.idempotency_key) {
    Statement key(database,
                  "INSERT INTO idempotency_keys (key, job_id, created_ms) VALUES (?, ?, ?)");
    key.Bind(*job.idempotency_key).Bind(id).Bind(now_ms).Run();
  }
  std::optional<Job> stored = SelectJob(database, id);
  Check(stored.has_value(), "an inserted job is there");
  return *std::move(stored);
}

std::optional<Job> ClaimJob(Database& database, ClientTurns& turns, std::int64_t now_ms) {
  if (!Any(database, "state = 'accepted'")) return std::nullopt;
  Transaction transaction(database);
  const bool busy = Any(database, "state = 'running'");
  if (busy && Any(database, "state = 'running' AND crashes > 0")) return std::nullopt;
  for (const WaitingClient& client : WaitingClients(database, turns)) {
    const std::optional<Candidate> next = CandidateOf(database, client.name, now_ms);
    if (!next) continue;
    // It waits for the others to end, and they for it: so its turn comes.
    if (next->alone && busy) return std::nullopt;
    std::optional<Job> job = Start(database, next->id, now_ms);
    transaction.Commit();
    turns.Serve(client.name);
    return job;
  }
  return std::nullopt;
}

std::int64_t RecoverJobs(Database& database, PreviousEnd end, std::int64_t now_ms) {
  Transaction transaction(database);
  // That these jobs ran was stored before their work began. So a crash counts even where the
  // process could not do anything more.
  Statement poison(database,
                   "UPDATE jobs SET state = 'failed', message = ?, failure_code = ?, "
                   "failure_kind = ?, failure_message = ?, finished_ms = ?, updated_ms = ? "
                   "WHERE state = 'running' AND (crashes + ? >= ? OR attempt >= ?)");
  const Error failure = {ErrorCode::kIo,
                         "the service died again and again while this job ran; the fault is ours, "
                         "the DEM that shows it is worth a report",
                         "poison-job"};
  poison.Bind(failure.message).Bind(std::string(ErrorCodeName(failure.code)));
  poison.Bind(std::string(failure.kind)).Bind(failure.message).Bind(now_ms).Bind(now_ms);
  poison.Bind(std::int64_t{end == PreviousEnd::kCrashed ? 1 : 0}).Bind(kMostCrashes);
  poison.Bind(kMostAttempts).Run();
  Statement again(database,
                  "UPDATE jobs SET state = 'accepted', message = 'waiting to run again', "
                  "crashes = crashes + ?, attempt = attempt - ?, updated_ms = ? "
                  "WHERE state = 'running'");
  again.Bind(std::int64_t{end == PreviousEnd::kCrashed ? 1 : 0});
  again.Bind(std::int64_t{end == PreviousEnd::kOrderly ? 1 : 0}).Bind(now_ms);
  const std::int64_t count = again.Run();
  transaction.Commit();
  return count;
}

}  // namespace farhorizon

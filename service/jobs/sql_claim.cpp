// Which of the waiting jobs starts: priority, then the fair share of clients, then age, as far as
// there is memory. Nothing waits for ever: every fourth start counts no priority, and what does not
// fit lets others pass for a while only.
#include "service/jobs/sql_claim.h"

#include <algorithm>
#include <tuple>
#include <vector>

#include "service/jobs/sql_rows.h"

namespace farhorizon {

namespace {

// No job is postponed for longer: a later time was written before the clock went back.
constexpr std::int64_t kLongestClaimDelayMs = std::int64_t{3600} * 1000;
// So long a job that must run alone, or that there is no memory for, lets others pass. Any value is
// sound; this one is a small part of the longest job's time.
constexpr std::int64_t kLongestPatienceMs = std::int64_t{600} * 1000;
// One start of as many goes by fair share and age alone, so that no job of low priority waits for
// ever. A job's rank does not grow with its age instead: then the client with the longest queue
// would outrank those who come with one job.
constexpr std::int64_t kStartsOfRank = 4;
// Beyond as many clients, those that are forgotten were served long ago.
constexpr std::size_t kMostClients = 10'000;

// A client with accepted jobs.
struct WaitingClient {
  std::int64_t running = 0;
  std::int64_t last_served = 0;
  std::string oldest;  // the id of its oldest job
  std::string name;
};

bool Any(const SqlDatabase& database, const std::string& condition) {
  return Statement(database, "SELECT 1 FROM jobs WHERE " + condition + " LIMIT 1").Step();
}

// One choice of a job.
class Claim {
 public:
  Claim(const SqlDatabase& database, const StartTurns& turns, const MemoryRoom& room,
        std::int64_t now_ms)
      : database_(database),
        turns_(turns),
        room_(room),
        now_ms_(now_ms),
        busy_(Any(database, RunningHere(database))) {}

  // The id and the client of the job to start; nullopt where none may.
  struct Choice {
    std::string id;
    std::string client;
  };
  std::optional<Choice> Choose() {
    if (busy_ && Any(database_, RunningHere(database_) + " AND crashes > 0")) return std::nullopt;
    if (turns_.AllAlike()) return ChooseOf("state = 'accepted'");
    for (int priority = static_cast<int>(Priority::kHigh); priority >= 0 && !blocked_; --priority) {
      std::optional<Choice> choice =
          ChooseOf("state = 'accepted' AND priority = " + std::to_string(priority));
      if (choice) return choice;
    }
    return std::nullopt;
  }

 private:
  // `jobs`: the condition of those to choose from.
  std::optional<Choice> ChooseOf(const std::string& jobs) {
    for (const WaitingClient& client : WaitingClients(jobs)) {
      std::optional<Choice> choice = OldestOf(jobs, client.name);
      if (choice || blocked_) return choice;
    }
    return std::nullopt;
  }

  // The clients that wait, in the order in which they are to be served. The statement steps from
  // client to client in an index, whatever the number of jobs.
  [[nodiscard]] std::vector<WaitingClient> WaitingClients(const std::string& jobs) const {
    const std::string least = "(SELECT min(client) FROM jobs WHERE " + jobs;
    const std::string& turn = database_.dialect().turn_of;
    Statement clients(database_,
                      "WITH RECURSIVE waiting(client) AS (SELECT " + least + ") UNION ALL SELECT " +
                          least +
                          " AND client > waiting.client) FROM waiting WHERE client IS NOT NULL) "
                          "SELECT client, (SELECT min(id) FROM jobs WHERE " +
                          jobs +
                          " AND jobs.client = waiting.client), (SELECT count(*) FROM jobs WHERE "
                          "state = 'running' AND jobs.client = waiting.client), " +
                          (turn.empty() ? "0" : turn) + " FROM waiting WHERE client IS NOT NULL");
    std::vector<WaitingClient> found;
    while (clients.Step()) {
      const std::string name = clients.Text(0);
      const std::int64_t served = turn.empty() ? turns_.LastOf(name) : clients.Integer(3);
      found.push_back({clients.Integer(2), served, clients.Text(1), name});
    }
    std::sort(found.begin(), found.end(), [](const WaitingClient& a, const WaitingClient& b) {
      return std::tie(a.running, a.last_served, a.oldest) <
             std::tie(b.running, b.last_served, b.oldest);
    });
    return found;
  }

  // The client's oldest job that may start now, or that has waited for so long that others wait for
  // it now: then the claim is blocked.
  std::optional<Choice> OldestOf(const std::string& jobs, const std::string& client) {
    const SqlDialect& dialect = database_.dialect();
    const std::string fits = "(crashes = 0 OR ? = 0) AND " + dialect.least +
                             "(CASE WHEN cost_memory_bytes > 0 THEN cost_memory_bytes ELSE ? END, "
                             "?) <= ?";
    Statement oldest(database_, "SELECT id, CASE WHEN " + fits +
                                    " THEN 1 ELSE 0 END FROM jobs WHERE " + jobs +
                                    " AND client = ? AND (not_before_ms <= ? OR not_before_ms > ?) "
                                    "AND (deadline_ms IS NULL OR deadline_ms > ?) "
                                    "AND (updated_ms <= ? OR (" +
                                    fits + ")) ORDER BY id LIMIT 1" + dialect.lock_free);
    const auto bind_fits = [&] {
      oldest.Bind(std::int64_t{busy_ ? 1 : 0});
      oldest.Bind(room_.most_bytes).Bind(room_.most_bytes).Bind(room_.free_bytes);
    };
    bind_fits();
    oldest.Bind(client).Bind(now_ms_).Bind(now_ms_ + kLongestClaimDelayMs);
    oldest.Bind(now_ms_).Bind(now_ms_ - kLongestPatienceMs);
    bind_fits();
    if (!oldest.Step()) return std::nullopt;
    blocked_ = oldest.Integer(1) == 0;
    if (blocked_) return std::nullopt;
    return Choice{oldest.Text(0), client};
  }

  const SqlDatabase& database_;
  const StartTurns& turns_;
  const MemoryRoom& room_;
  std::int64_t now_ms_;
  bool busy_;
  bool blocked_ = false;
};

std::optional<Job> Start(const SqlDatabase& database, const std::string& id, std::int64_t now_ms) {
  Statement start(database,
                  std::string("UPDATE jobs SET state = 'running', run = run + 1, attempt = "
                              "attempt + 1, started_ms = coalesce(started_ms, ?), updated_ms = ?, "
                              "message = 'starting'") +
                      database.dialect().claim + " WHERE id = ? RETURNING " + kJobColumns);
  start.Bind(now_ms).Bind(now_ms).Bind(id);
  std::optional<Job> job;
  while (start.Step()) job = ReadJob(start);
  return job;
}

}  // namespace

void StartTurns::Serve(const std::string& client) {
  if (last_.size() >= kMostClients) last_.clear();
  last_[client] = ++turns_;
}

std::int64_t StartTurns::LastOf(const std::string& client) const {
  const auto found = last_.find(client);
  return found == last_.end() ? 0 : found->second;
}

bool StartTurns::AllAlike() const { return turns_ % kStartsOfRank == kStartsOfRank - 1; }

std::optional<Job> ClaimJob(SqlDatabase& database, StartTurns& turns, const MemoryRoom& room,
                            std::int64_t now_ms) {
  if (!Any(database, "state = 'accepted'")) return std::nullopt;
  Transaction transaction(database);
  const auto choice = Claim(database, turns, room, now_ms).Choose();
  if (!choice) return std::nullopt;
  std::optional<Job> job = Start(database, choice->id, now_ms);
  const std::string& serve = database.dialect().serve_client;
  if (!serve.empty()) Statement(database, serve).Bind(choice->client).Run();
  transaction.Commit();
  turns.Serve(choice->client);
  return job;
}

}  // namespace farhorizon

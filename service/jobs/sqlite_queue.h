#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "core/base/result.h"
#include "service/jobs/job_store.h"
#include "service/jobs/sqlite.h"

namespace farhorizon {

/// The order in which the clients of this process were last served.
class ClientTurns {
 public:
  void Serve(const std::string& client);
  /// Less for a client that was served earlier; 0 for one that was not served.
  [[nodiscard]] std::int64_t LastOf(const std::string& client) const;

 private:
  std::int64_t turns_ = 0;
  std::map<std::string, std::int64_t> last_;
};

/// As JobStore::CheckQueue has it.
Status CheckQueue(const Database& database, const std::string& client, const QueueBounds& bounds);
/// As JobStore::Insert has it. Requires: within a transaction.
Result<Job> InsertInQueue(const Database& database, const NewJob& job, const QueueBounds& bounds,
                          std::int64_t now_ms);
/// As JobStore::ClaimNext has it.
std::optional<Job> ClaimJob(Database& database, ClientTurns& turns, std::int64_t now_ms);
/// As JobStore::RecoverRunning has it.
std::int64_t RecoverJobs(Database& database, PreviousEnd end, std::int64_t now_ms);

}  // namespace farhorizon

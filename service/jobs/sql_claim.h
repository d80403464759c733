#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "service/jobs/job_store.h"
#include "service/jobs/sql.h"

namespace farhorizon {

/// The jobs that this process has started, as far as the next one's choice depends on them.
class StartTurns {
 public:
  void Serve(const std::string& client);
  /// Less for a client that was served earlier; 0 for one that was not served.
  [[nodiscard]] std::int64_t LastOf(const std::string& client) const;
  /// Whether the next start is one of those that no priority counts for.
  [[nodiscard]] bool AllAlike() const;

 private:
  std::int64_t turns_ = 0;
  std::map<std::string, std::int64_t> last_;
};

/// As JobStore::ClaimNext has it.
std::optional<Job> ClaimJob(SqlDatabase& database, StartTurns& turns, const MemoryRoom& room,
                            std::int64_t now_ms);

}  // namespace farhorizon

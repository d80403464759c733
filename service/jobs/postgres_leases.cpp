#include "service/jobs/postgres_leases.h"

#include "service/jobs/postgres_listener.h"
#include "service/jobs/sql_rows.h"

namespace farhorizon {

namespace {

constexpr std::int64_t kMostLost = 10;

}  // namespace

std::vector<std::string> HoldRuns(const SqlDatabase& database, const std::vector<HeldRun>& runs) {
  std::vector<std::string> over;
  for (const auto& [id, run] : runs) {
    Statement hold(database, "UPDATE jobs SET run = run" + database.dialect().claim +
                                 " WHERE id = ? AND run = ? AND state = 'running'");
    if (hold.Bind(id).Bind(run).Run() == 0) over.push_back(id);
  }
  return over;
}

std::int64_t RecoverLostJobs(SqlDatabase& database, std::int64_t now_ms) {
  const std::string lost = " WHERE state = 'running' AND lease_until < clock_timestamp()";
  // Without a transaction where there is nothing to do, as nearly always.
  if (!Statement(database, "SELECT 1 FROM jobs" + lost + " LIMIT 1").Step()) return 0;
  Transaction transaction(database);
  const Error failure = {ErrorCode::kIo,
                         "service after service was lost while this job ran; the fault may be "
                         "ours, then the DEM that shows it is worth a report",
                         "poison-job"};
  Statement poison(database, std::string("UPDATE jobs SET ") + kSetFailed +
                                 ", updated_ms = ?, lost = lost + 1" + lost + " AND lost + 1 >= ?");
  BindFailure(poison, failure, now_ms).Bind(now_ms).Bind(kMostLost).Run();
  Statement again(database,
                  "UPDATE jobs SET state = 'accepted', lost = lost + 1, "
                  "message = 'waiting to run again', updated_ms = ?" +
                      lost);
  const int count = again.Bind(now_ms).Run();
  Tell(database, kNewsJobWaits);
  transaction.Commit();
  return count;
}

}  // namespace farhorizon

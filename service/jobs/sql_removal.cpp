// The end of jobs. A removal notes the objects of the job in the table `garbage` in the same
// transaction: so a process that ends before it has removed the files knows at its next start that
// they were its own.
#include "service/jobs/sql_removal.h"

#include <algorithm>

#include "service/jobs/sql_rows.h"
#include "service/jobs/sql_uploads.h"

namespace farhorizon {

namespace {

constexpr std::int64_t kMostRemoved = 100;

constexpr const char* kFinished = "finished_ms IS NOT NULL";

void RemoveJob(const SqlDatabase& database, const std::string& id) {
  Statement(database,
            "INSERT INTO garbage SELECT input_sha256 FROM jobs WHERE id = ? ON CONFLICT DO NOTHING")
      .Bind(id)
      .Run();
  RemoveArtifacts(database, id);
  Statement(database, "DELETE FROM jobs WHERE id = ?").Bind(id).Run();
}

// The ids that a statement gives, at most kMostRemoved.
std::vector<std::string> Ids(Statement& statement) {
  std::vector<std::string> ids;
  while (static_cast<std::int64_t>(ids.size()) < kMostRemoved && statement.Step()) {
    ids.push_back(statement.Text(0));
  }
  return ids;
}

std::vector<std::string> TooOld(const SqlDatabase& database, std::int64_t seconds,
                                std::int64_t now_ms) {
  Statement old(database, "SELECT id FROM jobs WHERE finished_ms <= ? ORDER BY finished_ms, id");
  return Ids(old.Bind(now_ms - seconds * 1000));
}

std::vector<std::string> TooMany(const SqlDatabase& database, std::int64_t jobs) {
  Statement count(database, std::string("SELECT count(*) FROM jobs WHERE ") + kFinished);
  count.Step();
  const std::int64_t over = count.Integer(0) - jobs;
  Statement oldest(database, std::string("SELECT id FROM jobs WHERE ") + kFinished +
                                 " ORDER BY finished_ms, id LIMIT ?");
  return Ids(oldest.Bind(std::max<std::int64_t>(0, over)));
}

// The oldest of those that take more than `bytes` together. Bytes that several jobs share count
// for each: the bound is kept, if not used up.
std::vector<std::string> TooLarge(const SqlDatabase& database, std::int64_t bytes) {
  const std::string size =
      "input_bytes + (SELECT coalesce(sum(bytes + coalesce(gzip_bytes, 0) + coalesce(zstd_bytes, "
      "0)), 0) FROM artifacts "
      "WHERE job_id = jobs.id)";
  Statement total(database, "SELECT coalesce(sum(" + size + "), 0) FROM jobs WHERE " + kFinished);
  total.Step();
  std::int64_t over = total.Integer(0) - bytes;
  std::vector<std::string> ids;
  if (over <= 0) return ids;
  Statement oldest(database, "SELECT id, " + size + " FROM jobs WHERE " + kFinished +
                                 " ORDER BY finished_ms, id LIMIT ?");
  oldest.Bind(kMostRemoved);
  while (over > 0 && oldest.Step()) {
    ids.push_back(oldest.Text(0));
    over -= oldest.Integer(1);
  }
  return ids;
}

}  // namespace

void RemoveArtifacts(const SqlDatabase& database, const std::string& id) {
  for (const std::string& object : ObjectsOf(SelectArtifacts(database, id))) {
    Statement(database, "INSERT INTO garbage VALUES (?) ON CONFLICT DO NOTHING").Bind(object).Run();
  }
  Statement(database, "DELETE FROM artifacts WHERE job_id = ?").Bind(id).Run();
}

Result<Job> DismissJob(SqlDatabase& database, const std::string& id, std::int64_t now_ms) {
  Transaction transaction(database);
  std::optional<Job> job = SelectJobToChange(database, id);
  if (!job) return NoSuchJob();
  if (IsTerminal(job->state)) {
    RemoveJob(database, id);
    job->state = JobState::kDismissed;
    job->failure.reset();
    job->message = "removed";
  } else {
    Statement update(database,
                     "UPDATE jobs SET state = 'dismissed', message = 'dismissed', "
                     "finished_ms = ?, updated_ms = ? WHERE id = ?");
    update.Bind(now_ms).Bind(now_ms).Bind(id).Run();
    job = SelectJob(database, id);
  }
  transaction.Commit();
  return *std::move(job);
}

std::int64_t RemoveExpiredJobs(SqlDatabase& database, const Retention& retention,
                               std::int64_t now_ms) {
  std::vector<std::string> ids;
  if (retention.seconds > 0) ids = TooOld(database, retention.seconds, now_ms);
  if (ids.empty() && retention.jobs > 0) ids = TooMany(database, retention.jobs);
  if (ids.empty() && retention.bytes > 0) ids = TooLarge(database, retention.bytes);
  if (ids.empty()) return 0;
  Transaction transaction(database);
  for (const std::string& id : ids) RemoveJob(database, id);
  transaction.Commit();
  return static_cast<std::int64_t>(ids.size());
}

bool IsReferenced(const SqlDatabase& database, const std::string& sha256) {
  Statement row(database,
                "SELECT 1 FROM jobs WHERE input_sha256 = ? UNION ALL "
                "SELECT 1 FROM artifacts WHERE sha256 = ? UNION ALL "
                "SELECT 1 FROM artifacts WHERE gzip_sha256 = ? UNION ALL "
                "SELECT 1 FROM artifacts WHERE zstd_sha256 = ? LIMIT 1");
  return row.Bind(sha256).Bind(sha256).Bind(sha256).Bind(sha256).Step() ||
         IsOfUpload(database, sha256);
}

std::vector<std::string> SelectGarbage(const SqlDatabase& database) {
  Statement rows(database, "SELECT sha256 FROM garbage");
  std::vector<std::string> names;
  while (rows.Step()) names.push_back(rows.Text(0));
  return names;
}

void ForgetGarbage(SqlDatabase& database, const std::vector<std::string>& names) {
  if (names.empty()) return;
  Transaction transaction(database);
  for (const std::string& name : names) {
    Statement(database, "DELETE FROM garbage WHERE sha256 = ?").Bind(name).Run();
  }
  transaction.Commit();
}

}  // namespace farhorizon

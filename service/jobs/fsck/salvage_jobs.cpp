// A scan of a table ends at the first page that cannot be read. So the ids are gathered from both
// ends of the table and of its indices, and each row is then copied by itself.
#include "service/jobs/fsck/salvage_jobs.h"

#include <set>

#include "service/jobs/sqlite.h"
#include "service/jobs/sqlite_job_store.h"

namespace farhorizon {

namespace {

constexpr std::size_t kMostComplaints = 20;

// Adds the ids that a scan gives before it ends, at its end or at a page that cannot be read.
void AddIds(const Database& database, const std::string& scan, std::set<std::string>& ids) {
  try {
    Statement rows(database, "SELECT id FROM main.jobs " + scan);
    while (rows.Step()) ids.insert(rows.Text(0));
  } catch (const SqlFailure&) {  // the next scan comes from elsewhere
  }
}

// Runs a statement on one job; false where it fails.
bool Copy(const Database& database, const std::string& sql, const std::string& id) {
  try {
    Statement(database, sql).Bind(id).Run();
    return true;
  } catch (const SqlFailure&) {
    return false;
  }
}

// The columns that the damaged table has: those of its version.
std::string Columns(const Database& database, const std::string& table) {
  std::string columns;
  Statement info(database, "PRAGMA main.table_info(" + table + ")");
  while (info.Step()) columns += (columns.empty() ? "" : ", ") + info.Text(1);
  return columns;
}

void CopyIdentity(Database& database) {
  try {
    database.Execute(
        "UPDATE fresh.store SET (id, generation) = (SELECT id, generation FROM main.store)");
  } catch (const SqlFailure&) {  // an earlier version, or unreadable: the new one is as good
  }
}

}  // namespace

std::vector<std::string> ComplaintsOf(const std::filesystem::path& path) {
  std::vector<std::string> complaints;
  try {
    Database database;
    database.Open(path);
    Statement check(database, "PRAGMA quick_check(" + std::to_string(kMostComplaints) + ")");
    while (check.Step()) {
      if (check.Text(0) != "ok") complaints.push_back(check.Text(0));
    }
  } catch (const SqlFailure& failure) {
    complaints.push_back(failure.error.message);
  }
  return complaints;
}

std::int64_t SchemaVersionOf(const std::filesystem::path& path) {
  try {
    Database database;
    database.Open(path);
    return database.Pragma("user_version");
  } catch (const SqlFailure&) {
    return 0;
  }
}

Result<std::int64_t> SalvageJobs(const std::filesystem::path& damaged,
                                 const std::filesystem::path& fresh) {
  {
    Result<std::unique_ptr<JobStore>> made = OpenSqliteJobStore(fresh);
    if (!made) return std::move(made.error());
  }
  try {
    Database database;
    database.Open(damaged);
    Statement(database, "ATTACH ? AS fresh").Bind(fresh.string()).Run();
    const std::string columns = Columns(database, "jobs");
    if (columns.empty()) {
      return Error{ErrorCode::kIo, "the database has no table of jobs", "job-store-unusable"};
    }
    std::set<std::string> ids;
    for (const char* scan :
         {"ORDER BY id", "ORDER BY id DESC", "INDEXED BY jobs_by_state",
          "INDEXED BY jobs_by_state ORDER BY state DESC, id DESC", "INDEXED BY jobs_by_input"}) {
      AddIds(database, scan, ids);
    }
    std::int64_t copied = 0;
    for (const std::string& id : ids) {
      const bool whole = Copy(database,
                              "INSERT OR IGNORE INTO fresh.jobs (" + columns + ") SELECT " +
                                  columns + " FROM main.jobs WHERE id = ?",
                              id);
      if (!whole) continue;
      ++copied;
      for (const char* table : {"artifacts", "idempotency_keys", "callbacks"}) {
        const std::string both = Columns(database, table);
        Copy(database,
             std::string("INSERT OR IGNORE INTO fresh.") + table + " (" + both + ") SELECT " +
                 both + " FROM main." + table + " WHERE job_id = ?",
             id);
      }
    }
    CopyIdentity(database);
    return copied;
  } catch (SqlFailure& failure) {
    return std::move(failure.error);
  }
}

}  // namespace farhorizon

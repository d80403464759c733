#include "service/jobs/fsck/check_database.h"

#include <string>
#include <system_error>
#include <vector>

#include "service/jobs/fsck/check_objects.h"
#include "service/jobs/fsck/salvage_jobs.h"
#include "service/jobs/sqlite_schema.h"

namespace farhorizon {

namespace {

namespace fs = std::filesystem;

bool Salvage(FsckRun& run) {
  const std::string line = "jobs.sqlite is damaged";
  if (!run.options.repair) {
    run.Fault(line + ": --repair takes out of it what can be read", false);
    return false;
  }
  const fs::path fresh = run.directory.root / "jobs.sqlite.new";
  for (const char* end : {"", "-wal", "-shm"}) fs::remove(fresh.string() + end);
  const Result<std::int64_t> salvaged = SalvageJobs(run.directory.Jobs(), fresh);
  if (!salvaged) {
    run.Fault(line + " and cannot be read: put it back from a backup", false);
    return false;
  }
  // With its log: the two are one database.
  for (const char* end : {"-wal", "-shm", ""}) {
    const fs::path part = run.directory.Jobs().string() + end;
    if (!fs::exists(part) || MoveAside(part, run.directory.root / "stray" / "database")) continue;
    run.Fault(line + " and cannot be moved aside", false);
    return false;
  }
  fs::rename(fresh, run.directory.Jobs());
  run.Fault(line + ": " + std::to_string(*salvaged) + " jobs were read", true);
  return true;
}

}  // namespace

bool CheckDatabase(FsckRun& run) {
  std::error_code failure;
  const std::uintmax_t size = fs::file_size(run.directory.Jobs(), failure);
  if (failure || size == 0) {
    run.Fault("jobs.sqlite is missing or empty: put it back from a backup", false);
    return false;
  }
  const std::vector<std::string> complaints = ComplaintsOf(run.directory.Jobs());
  for (const std::string& complaint : complaints) run.options.say("jobs.sqlite: " + complaint);
  if (!complaints.empty()) return Salvage(run);
  const std::int64_t version = SchemaVersionOf(run.directory.Jobs());
  if (version > kSchemaVersion) {
    run.Fault("jobs.sqlite comes from a newer farhorizon: use that one", false);
    return false;
  }
  if (version == kSchemaVersion || run.options.repair) return true;
  run.options.say(
      "jobs.sqlite is of an earlier version: its rows are looked at with --repair, or "
      "after a start, which bring it forward");
  return false;
}

}  // namespace farhorizon

#include "service/jobs/fsck/check_store.h"

#include <system_error>
#include <utility>

#include "service/jobs/fsck/check_database.h"
#include "service/jobs/fsck/check_jobs.h"
#include "service/jobs/fsck/check_objects.h"
#include "service/jobs/fsck/check_uploads.h"
#include "service/jobs/fsck/fsck_run.h"
#include "service/jobs/sqlite_schema.h"

namespace farhorizon {

namespace {

namespace fs = std::filesystem;

// Of a process that was killed: no fault, for every start removes them.
void SayLeftovers(const FsckRun& run) {
  for (const fs::path& folder :
       {run.directory.Spool(), run.directory.Work(), run.directory.Objects() / "temp"}) {
    std::error_code failure;
    for (fs::directory_iterator it(folder, failure), end; !failure && it != end;
         it.increment(failure)) {
      run.options.say("left by a killed process: " +
                      it->path().lexically_relative(run.directory.root).string() +
                      ": a start removes it");
    }
  }
}

void TakeObjects(FsckRun& run, CheckedObjects found) {
  run.good = std::move(found.good);
  run.sum.objects = static_cast<std::int64_t>(run.good.size() + found.damaged.size());
  for (const auto& [name, bytes] : run.good) run.sum.bytes += bytes;
  for (const fs::path& file : found.damaged) {
    run.Fault("damaged object " + file.filename().string(), run.SetAside(file, "damaged"));
  }
  for (const fs::path& file : found.unfitting) {
    run.Fault("no file in the place of object " + file.filename().string(),
              run.SetAside(file, "damaged"));
  }
}

// Throws SqlFailure where the database fails on the way.
Result<FsckSum> Look(FsckRun& run) {
  SayLeftovers(run);
  const bool rows = CheckDatabase(run);
  Result<CheckedObjects> objects = CheckObjects(run.directory.Objects());
  if (!objects) return std::move(objects.error());
  TakeObjects(run, *std::move(objects));
  if (!rows) return run.sum;
  Database database;
  database.Open(run.directory.Jobs());
  PrepareSchema(database);
  CheckUploads(run, database);
  CheckJobs(run, database);
  return run.sum;
}

}  // namespace

Result<FsckSum> CheckStore(const FsckOptions& options) {
  std::error_code failure;
  if (!fs::exists(options.data / "jobs.sqlite", failure) &&
      !fs::exists(options.data / "objects", failure)) {
    return Error{ErrorCode::kIo, options.data.string() + " has no store of farhorizon",
                 "data-directory"};
  }
  Result<DataDirectory> directory = LockDataDirectory(options.data);
  if (!directory) return std::move(directory.error());
  fs::create_directories(directory->Objects(), failure);
  try {
    FsckRun run{options, *directory};
    return Look(run);
  } catch (SqlFailure& failed) {
    return std::move(failed.error);
  }
}

}  // namespace farhorizon

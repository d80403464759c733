#include "service/jobs/fsck/check_store.h"

#include <map>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "service/clock.h"
#include "service/jobs/data_directory.h"
#include "service/jobs/fsck/check_objects.h"
#include "service/jobs/fsck/salvage_jobs.h"
#include "service/jobs/sqlite.h"
#include "service/jobs/sqlite_rows.h"
#include "service/jobs/sqlite_schema.h"
#include "service/jobs/store_identity.h"

namespace farhorizon {

namespace {

namespace fs = std::filesystem;

constexpr int kPage = 1000;

class Checker {
 public:
  Checker(const FsckOptions& options, const DataDirectory& directory)
      : options_(options), directory_(directory) {}

  // Throws SqliteFailure where the database fails on the way.
  Result<FsckSum> Run();

 private:
  void Fault(const std::string& line, bool mended);
  bool SetAside(const fs::path& file, const char* why);
  // Each returns whether the rows can be looked at.
  bool CheckDatabase();
  bool Salvage();
  void CheckObjectFiles(CheckedObjects found);
  void CheckJobs(Database& database);
  void CheckJob(Database& database, const Job& job);
  // What becomes of a job whose results are lost: runs again where its upload is there.
  void MendJob(Database& database, const Job& job, const std::string& why);
  void CheckReferences(Database& database);

  const FsckOptions& options_;
  const DataDirectory& directory_;
  FsckSum sum_;
  std::map<std::string, std::int64_t> good_;
};

void Checker::Fault(const std::string& line, bool mended) {
  ++sum_.faults;
  if (mended) ++sum_.mended;
  options_.say(line + (mended ? ": mended" : ""));
}

bool Checker::SetAside(const fs::path& file, const char* why) {
  return options_.repair && MoveAside(file, directory_.root / "stray" / why);
}

Result<FsckSum> Checker::Run() {
  const bool rows = CheckDatabase();
  Result<CheckedObjects> objects = CheckObjects(directory_.Objects());
  if (!objects) return std::move(objects.error());
  CheckObjectFiles(*std::move(objects));
  if (!rows) return sum_;
  Database database;
  database.Open(directory_.Jobs());
  PrepareSchema(database);
  CheckJobs(database);
  CheckReferences(database);
  return sum_;
}

bool Checker::CheckDatabase() {
  std::error_code failure;
  const std::uintmax_t size = fs::file_size(directory_.Jobs(), failure);
  if (failure || size == 0) {
    Fault("jobs.sqlite is missing or empty: put it back from a backup", false);
    return false;
  }
  const std::vector<std::string> complaints = ComplaintsOf(directory_.Jobs());
  for (const std::string& complaint : complaints) options_.say("jobs.sqlite: " + complaint);
  if (!complaints.empty()) return Salvage();
  const std::int64_t version = SchemaVersionOf(directory_.Jobs());
  if (version > kSchemaVersion) {
    Fault("jobs.sqlite comes from a newer farhorizon: use that one", false);
    return false;
  }
  if (version == kSchemaVersion || options_.repair) return true;
  options_.say(
      "jobs.sqlite is of an earlier version: its rows are looked at with --repair, or "
      "after a start, which bring it forward");
  return false;
}

bool Checker::Salvage() {
  const std::string line = "jobs.sqlite is damaged";
  if (!options_.repair) {
    Fault(line + ": --repair takes out of it what can be read", false);
    return false;
  }
  const fs::path fresh = directory_.root / "jobs.sqlite.new";
  for (const char* end : {"", "-wal", "-shm"}) fs::remove(fresh.string() + end);
  const Result<std::int64_t> salvaged = SalvageJobs(directory_.Jobs(), fresh);
  if (!salvaged) {
    Fault(line + " and cannot be read: put it back from a backup", false);
    return false;
  }
  // With its log: the two are one database.
  for (const char* end : {"-wal", "-shm", ""}) {
    const fs::path part = directory_.Jobs().string() + end;
    if (fs::exists(part) && !MoveAside(part, directory_.root / "stray" / "database")) return false;
  }
  fs::rename(fresh, directory_.Jobs());
  Fault(line + ": " + std::to_string(*salvaged) + " jobs were read", true);
  return true;
}

void Checker::CheckObjectFiles(CheckedObjects found) {
  good_ = std::move(found.good);
  sum_.objects = static_cast<std::int64_t>(good_.size() + found.damaged.size());
  for (const auto& [name, bytes] : good_) sum_.bytes += bytes;
  for (const fs::path& file : found.damaged) {
    Fault("damaged object " + file.filename().string(), SetAside(file, "damaged"));
  }
  for (const fs::path& file : found.unfitting) {
    Fault("no file in the place of object " + file.filename().string(), SetAside(file, "damaged"));
  }
}

void Checker::CheckJobs(Database& database) {
  JobQuery query{{}, {}, kPage};
  for (;;) {
    const JobPage page = SelectPage(database, query);
    sum_.jobs += static_cast<std::int64_t>(page.jobs.size());
    for (const Job& job : page.jobs) CheckJob(database, job);
    if (!page.next) return;
    query.before = page.next;
  }
}

void Checker::CheckJob(Database& database, const Job& job) {
  if (!IsTerminal(job.state)) {
    if (good_.contains(job.input_sha256)) return;
    return MendJob(database, job, "its upload is lost");
  }
  if (job.state != JobState::kSuccessful) return;
  for (const Artifact& artifact : SelectArtifacts(database, job.id)) {
    const auto object = good_.find(artifact.sha256);
    if (object != good_.end() && object->second == artifact.bytes) continue;
    return MendJob(database, job, "its result " + artifact.name + " is lost or damaged");
  }
}

void Checker::MendJob(Database& database, const Job& job, const std::string& why) {
  const std::string line = "job " + job.id + ": " + why;
  if (!options_.repair) return Fault(line, false);
  Transaction transaction(database);
  Statement(database, "DELETE FROM artifacts WHERE job_id = ?").Bind(job.id).Run();
  const bool again = good_.contains(job.input_sha256);
  if (again) {
    Statement(database,
              "UPDATE jobs SET state = 'accepted', message = 'waiting to run again', progress = 0, "
              "finished_ms = NULL WHERE id = ?")
        .Bind(job.id)
        .Run();
  } else {
    Statement(database,
              "UPDATE jobs SET state = 'failed', failure_code = 'io', failure_kind = ?, "
              "failure_message = ?, message = ?, finished_ms = coalesce(finished_ms, ?) "
              "WHERE id = ?")
        .Bind(std::string(job.state == JobState::kSuccessful ? ErrorKind("result-corrupt")
                                                             : ErrorKind("input-corrupt")))
        .Bind(why + "; submit the DEM again")
        .Bind(why + "; submit the DEM again")
        .Bind(NowMs())
        .Bind(job.id)
        .Run();
  }
  transaction.Commit();
  Fault(line + (again ? "; it runs again" : "; it has failed"), true);
}

// What is left of the objects: each belongs to a row, or to a removed job, or is a stray.
void Checker::CheckReferences(Database& database) {
  for (const auto& [name, bytes] : good_) {
    Statement row(database,
                  "SELECT 1 FROM jobs WHERE input_sha256 = ? UNION ALL SELECT 1 FROM artifacts "
                  "WHERE sha256 = ? UNION ALL SELECT 1 FROM garbage WHERE sha256 = ? LIMIT 1");
    if (row.Bind(name).Bind(name).Bind(name).Step()) continue;
    const fs::path kept = directory_.Objects() / name.substr(0, 2) / name;
    if (fs::exists(directory_.Objects() / "incoming" / name)) {
      options_.say("object " + name + " was never acknowledged: a start removes it");
      continue;
    }
    Fault("stray object " + name + ": no job knows it",
          options_.repair && MoveAside(kept, directory_.Objects() / "stray"));
  }
  if (!options_.repair) return;
  const StoreIdentity identity = SelectIdentity(database);
  const Status written = WriteIdentity(directory_, identity);
  if (!written) Fault("the identity beside the objects: " + written.error().message, false);
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
    return Checker(options, *directory).Run();
  } catch (SqliteFailure& failed) {
    return std::move(failed.error);
  }
}

}  // namespace farhorizon

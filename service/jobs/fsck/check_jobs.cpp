#include "service/jobs/fsck/check_jobs.h"

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "service/clock.h"
#include "service/jobs/coding.h"
#include "service/jobs/fsck/check_objects.h"
#include "service/jobs/sql_removal.h"
#include "service/jobs/sql_rows.h"
#include "service/jobs/store_identity.h"

namespace farhorizon {

namespace {

namespace fs = std::filesystem;

constexpr int kPage = 1000;

// What becomes of a job that cannot stay as it is, and why: it runs again, or has failed.
struct Lot {
  std::string why;
  bool again = false;
};

void MendJob(FsckRun& run, Database& database, const Job& job, const Lot& lot) {
  const std::string line = "job " + job.id + ": " + lot.why;
  if (!run.options.repair) return run.Fault(line, false);
  Transaction transaction(database);
  RemoveArtifacts(database, job.id);
  if (lot.again) {
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
        .Bind(lot.why + "; submit the DEM again")
        .Bind(lot.why + "; submit the DEM again")
        .Bind(NowMs())
        .Bind(job.id)
        .Run();
  }
  transaction.Commit();
  run.Fault(line + (lot.again ? "; it runs again" : "; it has failed"), true);
}

bool IsGood(const FsckRun& run, const StoredObject& object) {
  const auto found = run.good.find(object.sha256);
  return found != run.good.end() && found->second == object.bytes;
}

// A result whose compressed copy is lost is sent as it is.
void CheckCopy(FsckRun& run, Database& database, const std::string& id, const std::string& name,
               Coding coding, const std::optional<StoredObject>& copy) {
  if (!copy || IsGood(run, *copy)) return;
  if (run.options.repair) {
    const std::string column(CodingName(coding));
    Statement(database, "UPDATE artifacts SET " + column + "_sha256 = NULL, " + column +
                            "_bytes = NULL WHERE job_id = ? AND name = ?")
        .Bind(id)
        .Bind(name)
        .Run();
  }
  run.Fault("job " + id + ": the compressed copy of " + name + " is lost or damaged",
            run.options.repair);
}

void CheckJob(FsckRun& run, Database& database, const Job& job) {
  if (!IsTerminal(job.state)) {
    if (job.failure) return MendJob(run, database, job, {"its row is damaged", false});
    if (run.good.contains(job.input_sha256)) return;
    return MendJob(run, database, job, {"its upload is lost", false});
  }
  if (job.state != JobState::kSuccessful) return;
  for (const Artifact& artifact : SelectArtifacts(database, job.id)) {
    if (IsGood(run, {artifact.sha256, artifact.bytes})) {
      CheckCopy(run, database, job.id, artifact.name, Coding::kGzip, artifact.gzip);
      CheckCopy(run, database, job.id, artifact.name, Coding::kZstd, artifact.zstd);
      continue;
    }
    return MendJob(run, database, job,
                   {"its result " + artifact.name + " is lost or damaged",
                    run.good.contains(job.input_sha256)});
  }
}

// What is left of the objects: each belongs to a row, or to a removed job, or is a stray.
void CheckReferences(FsckRun& run, Database& database) {
  const std::vector<std::string> listed = SelectGarbage(database);
  const std::set<std::string> garbage(listed.begin(), listed.end());
  for (const auto& [name, bytes] : run.good) {
    if (garbage.contains(name) || IsReferenced(database, name)) continue;
    const fs::path kept = run.directory.Objects() / name.substr(0, 2) / name;
    if (fs::exists(run.directory.Objects() / "incoming" / name)) {
      run.options.say("object " + name + " was never acknowledged: a start removes it");
      continue;
    }
    run.Fault("stray object " + name + ": no job knows it",
              run.options.repair && MoveAside(kept, run.directory.Objects() / "stray"));
  }
}

// The objects may be those of another database, or of a later state of this one.
void CheckIdentity(FsckRun& run, const Database& database) {
  const StoreIdentity own = SelectIdentity(database);
  const std::optional<StoreIdentity> beside = ReadIdentity(run.directory);
  if (beside && beside->id == own.id && beside->generation <= own.generation) return;
  const bool written = run.options.repair && WriteIdentity(run.directory, own);
  if (beside) run.Fault("the objects were used with another database, or a newer one", written);
}

}  // namespace

void CheckJobs(FsckRun& run, Database& database) {
  JobQuery query{{}, {}, kPage};
  for (;;) {
    const JobPage page = SelectPage(database, query);
    run.sum.jobs += static_cast<std::int64_t>(page.jobs.size());
    for (const Job& job : page.jobs) CheckJob(run, database, job);
    if (!page.next) break;
    query.before = page.next;
  }
  CheckReferences(run, database);
  CheckIdentity(run, database);
}

}  // namespace farhorizon

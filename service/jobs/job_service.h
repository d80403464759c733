#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <memory>
#include <semaphore>
#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "service/jobs/data_directory.h"
#include "service/jobs/job_engine.h"
#include "service/jobs/job_store.h"
#include "service/jobs/object_keeper.h"
#include "service/jobs/object_store.h"
#include "service/jobs/spool_file.h"

namespace farhorizon {

struct JobServiceOptions {
  std::filesystem::path data;
  EngineOptions engine;
  std::int64_t max_waiting = 1000;
  std::int64_t min_free_bytes = 0;
  WorkerLimits probe_limits;
  std::int64_t probe_max_bytes = 0;  ///< larger uploads are read by their job only
};

/// A client's DEM and its wishes.
struct Submission {
  std::string filename;  ///< as SafeFilename gives it
  Parameters parameters;
  std::optional<std::string> idempotency_key;
};

/// An artifact, open for reading.
struct OpenArtifact {
  Artifact artifact;
  OpenObject object;
};

/// Everything that handlers can ask of jobs: the stores, the engine and the rules between them.
/// Threads: safe.
class JobService {
 public:
  /// Opens the data directory, takes up what an earlier process left, and starts the engine.
  /// Errors: kIo, with the remedy.
  static Result<std::unique_ptr<JobService>> Open(JobServiceOptions options);
  ~JobService();

  /// Whether a new job would be taken now. Errors: kResourceExhausted "draining", "queue-full",
  ///   "no-space".
  Status CheckRoom();
  Result<SpoolFile> NewSpoolFile() { return SpoolFile::Create(directory_.Spool()); }

  /// Lets a worker read the upload, without building anything. Succeeds too where it cannot be told
  /// within the probe's limits: the job will tell. Errors: what ReadDem said.
  Status Probe(const SpoolFile& upload, const Submission& submission);

  /// Stores bytes and job; `second` is true where an earlier submission with this key is answered.
  /// Both are durable when this returns. Errors: those of the stores.
  Result<std::pair<Job, bool>> Submit(const SpoolFile& upload, const Submission& submission);

  Result<Job> Find(const std::string& id) { return jobs_->Find(id); }
  Result<JobPage> List(const JobQuery& query) { return jobs_->List(query); }
  Result<std::vector<Artifact>> Artifacts(const std::string& id) { return jobs_->Artifacts(id); }
  /// Errors: kNotFound; kIo "result-corrupt" where the object is missing or has another size.
  Result<OpenArtifact> Open(const std::string& id, const std::string& name);
  Result<Job> Dismiss(const std::string& id);

  /// Whether new work can be taken and finished. Errors: as CheckRoom, and those of the stores.
  Status CheckReady();

  /// Takes nothing more; says so in CheckReady and CheckRoom.
  void Drain();
  bool WaitIdle(std::chrono::milliseconds most) { return engine_->WaitIdle(most); }
  /// Gives back what still runs. The last call.
  void Stop() { engine_->Stop(); }

 private:
  JobService(JobServiceOptions options, DataDirectory directory, std::unique_ptr<JobStore> jobs,
             std::unique_ptr<ObjectStore> objects);
  Status CheckDisk();

  JobServiceOptions options_;
  DataDirectory directory_;
  std::unique_ptr<JobStore> jobs_;
  std::unique_ptr<ObjectStore> objects_;
  ObjectKeeper keeper_;
  std::atomic<bool> draining_{false};
  std::atomic<std::int64_t> next_probe_{0};
  std::counting_semaphore<> probes_;
  std::unique_ptr<JobEngine> engine_;
};

}  // namespace farhorizon

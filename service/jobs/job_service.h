#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <semaphore>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "service/jobs/data_directory.h"
#include "service/jobs/housekeeper.h"
#include "service/jobs/job_engine.h"
#include "service/jobs/job_runner.h"
#include "service/jobs/job_store.h"
#include "service/jobs/object_collector.h"
#include "service/jobs/object_store.h"
#include "service/jobs/spool_file.h"
#include "service/jobs/storage_health.h"
#include "service/jobs/verified_object.h"

namespace farhorizon {

/// Limits of reading an upload before its job is accepted.
struct ProbeOptions {
  std::int64_t max_bytes = std::int64_t{1} << 31U;  ///< larger uploads are read by their job only
  /// What ends a probe for want of memory is no fault of the DEM: its job has more.
  std::int64_t memory_bytes = std::int64_t{1} << 30U;
  /// A probe reads the header of a large raster alone: it takes some 100 ms of a free core.
  std::int64_t wall_seconds = 5;
};

struct JobServiceOptions {
  std::filesystem::path data = "farhorizon-data";
  int workers = 1;  ///< jobs at once
  RunnerOptions runner;
  std::int64_t max_waiting = 1000;
  /// Of one client's; 0: all but an eighth of max_waiting.
  std::int64_t max_waiting_per_client = 0;
  std::int64_t min_free_bytes = std::int64_t{1} << 28U;
  /// A month; as many jobs as the list of them pages through in a second.
  Retention retention = {30 * 86400, 100'000, 0};
  ProbeOptions probe;
};

/// A client's DEM and its parameters.
struct Submission {
  std::string filename;  ///< as SafeFilename gives it
  Parameters parameters;
  std::optional<std::string> idempotency_key;
  Assumptions assumptions = {};  ///< those of the probe
  std::string client = {};       ///< the peer's address
};

/// One thing that a service depends on.
struct ReadinessCheck {
  const char* name;
  Status status;
};

/// How the bytes of an artifact are coded on their way [RFC 9110, section 8.4].
enum class Coding { kIdentity, kGzip };

/// An artifact, open for reading: no wrong byte of it can be read.
struct OpenArtifact {
  Artifact artifact;
  Coding coding = Coding::kIdentity;
  StoredObject stored;  ///< the bytes as they are coded
  std::shared_ptr<VerifiedObject> object;
};

/// The interface of jobs for the handlers: stores, engine and the rules that connect them.
/// Threads: safe.
class JobService {
 public:
  /// Opens the data directory, makes jobs of an earlier process accepted again, and starts the
  /// engine.
  /// Errors: kIo, with the remedy.
  static Result<std::unique_ptr<JobService>> Open(JobServiceOptions options);
  ~JobService();

  /// Succeeds if a new job of `client` would be accepted now. Errors: kResourceExhausted
  ///   "draining", "queue-full", "too-many-jobs", "no-space"; kIo "data-directory".
  Status CheckRoom(const std::string& client);
  Result<SpoolFile> NewSpoolFile() { return SpoolFile::Create(directory_.Spool()); }

  /// Reads, places and plans the upload in a worker process, without building anything; returns
  /// what was assumed. Succeeds, with what is known by then, also where the limits of the probe end
  /// the worker: the job has larger ones.
  /// Errors: those of TerrainInput::Open and PlanLevels.
  Result<Assumptions> Probe(const SpoolFile& upload, const Submission& submission);

  /// Stores the bytes and an accepted job, durably, and returns the job: an earlier one where the
  /// idempotency key has made one. Errors: those of the stores.
  Result<Job> Submit(const SpoolFile& upload, const Submission& submission);

  Result<Job> Find(const std::string& id);
  Result<JobPage> List(const JobQuery& query);
  Result<std::vector<Artifact>> Artifacts(const std::string& id) { return jobs_->Artifacts(id); }
  /// coding: in which the artifact is wanted; it is given as it is where there is no such copy.
  /// Errors: kNotFound; kIo "result-corrupt" where the object is missing or damaged.
  Result<OpenArtifact> Open(const std::string& id, const std::string& name, Coding coding);
  /// Dismisses the job, stops its worker and removes its objects. Errors: kNotFound.
  Result<Job> Dismiss(const std::string& id);

  /// What accepting and running jobs depends on: the service is ready if all succeed. Writes to the
  /// disk and to the store.
  std::vector<ReadinessCheck> CheckReady();
  Result<UnfinishedJobs> CountUnfinished() { return jobs_->CountUnfinished(); }
  /// Room on the disk of the data folder.
  [[nodiscard]] Result<std::int64_t> FreeBytes() const;

  /// What encloses each worker process.
  [[nodiscard]] SandboxLayers ActiveSandbox() const;

  /// Accepts and starts no further job; CheckReady and CheckRoom fail from now on.
  void Drain();
  bool WaitIdle(std::chrono::milliseconds most) { return engine_->WaitIdle(most); }
  /// Stops every worker; their jobs are accepted again. The last call.
  void Stop();

  /// Notes how this process ends, for the next one to know whether a job may be at fault. To be
  /// called once, by a process that has no other service.
  void MarkEnd();

 private:
  JobService(JobServiceOptions options, DataDirectory directory, std::unique_ptr<JobStore> jobs,
             std::unique_ptr<ObjectStore> objects);
  [[nodiscard]] QueueBounds Bounds() const;
  /// nullptr where it is missing or damaged.
  std::shared_ptr<VerifiedObject> OpenSound(const StoredObject& stored);
  Status SortOut();
  void Begin();
  void SetExpiry(Job& job) const;
  /// The job as DELETE leaves it. Needs no free byte of the disk while there is a reserve.
  Result<Job> DismissWithReserve(const std::string& id);

  JobServiceOptions options_;
  DataDirectory directory_;
  std::unique_ptr<JobStore> jobs_;
  std::unique_ptr<ObjectStore> objects_;
  ObjectCollector collector_;
  ObjectVerifier verifier_;
  StorageHealth health_;
  DiskReserve reserve_;
  std::atomic<bool> draining_{false};
  std::atomic<std::int64_t> next_probe_{0};
  std::counting_semaphore<> probes_;
  JobRunner runner_;
  std::unique_ptr<JobEngine> engine_;
  std::unique_ptr<Housekeeper> housekeeper_;
};

}  // namespace farhorizon

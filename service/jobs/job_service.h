#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/pipeline/build_options.h"
#include "service/jobs/coding.h"
#include "service/jobs/data_directory.h"
#include "service/jobs/housekeeper.h"
#include "service/jobs/job_changes.h"
#include "service/jobs/job_engine.h"
#include "service/jobs/job_runner.h"
#include "service/jobs/job_store.h"
#include "service/jobs/memory_plan.h"
#include "service/jobs/object_collector.h"
#include "service/jobs/object_store.h"
#include "service/jobs/open_stores.h"
#include "service/jobs/spool_file.h"
#include "service/jobs/storage_health.h"
#include "service/jobs/upload_probe.h"
#include "service/jobs/upload_service.h"
#include "service/jobs/verified_object.h"

namespace farhorizon {

struct JobServiceOptions {
  std::filesystem::path data = "farhorizon-data";
  StoreOptions store;
  int workers = 1;  ///< jobs at once
  RunnerOptions runner;
  std::int64_t max_waiting = 1000;
  /// Of one client's; 0: all but an eighth of max_waiting.
  std::int64_t max_waiting_per_client = 0;
  std::int64_t min_free_bytes = std::int64_t{1} << 28U;
  /// A month; as many jobs as the list of them pages through in a second.
  Retention retention = {30 * 86400, 100'000, 0};
  ProbeOptions probe;
  std::int64_t memory_bytes = 0;  ///< of workers and probes together; 0: the machine's
  Priority highest_priority = Priority::kHigh;
  std::int64_t deadline_seconds = 0;  ///< of a job that comes without one; 0: none
  std::int64_t max_watches = 512;     ///< requests at once that wait for changes of jobs
  UploadOptions uploads;
};

/// A client's DEM and its parameters.
struct Submission {
  std::string filename;  ///< as SafeFilename gives it
  Parameters parameters;
  std::optional<std::string> idempotency_key;
  Assumptions assumptions = {};  ///< those of the probe
  std::string client = {};       ///< whose turn it takes: its owner, or the peer's address
  JobTerms terms = {};
  JobCost cost = {};          ///< likewise
  BuildOptions options = {};  ///< what the parameters mean
  std::string process = kTerrainProcess;
  std::string answer = {};  ///< as Job has it
  std::string owner = {};   ///< whose key it comes with; empty: no key was asked for
  std::string upload = {};  ///< the id of the Upload that its bytes are of; empty: of none
  std::string source = {};  ///< as NewJob has it
  Subscriber subscriber = {};
};

/// One thing that a service depends on.
struct ReadinessCheck {
  const char* name;
  Status status;
};

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
  /// Shares out the memory, opens the data directory, makes jobs of an earlier process accepted
  /// again, and starts the engine.
  /// Errors: kIo, kInvalidArgument "invalid-config" where there is too little memory for a job;
  ///   each with the remedy.
  static Result<std::unique_ptr<JobService>> Open(JobServiceOptions options);
  ~JobService();

  /// Succeeds if a new job of `client` would be accepted now. Errors: kResourceExhausted
  ///   "draining", "queue-full", "too-many-jobs", "no-space"; kIo "data-directory".
  Status CheckRoom(const std::string& client);
  /// The same for an upload, which takes no place in the queue.
  Status CheckUploadRoom() const;
  UploadService& Uploads() { return uploads_; }
  Result<SpoolFile> NewSpoolFile() { return SpoolFile::Create(directory_.Spool()); }

  /// As UploadProbe::Look has it.
  Result<ProbeReport> Probe(const SpoolFile& upload, const Submission& submission) {
    return probe_.Look(upload, submission.filename, submission.parameters, submission.options);
  }

  /// Stores the bytes and an accepted job, durably, and returns the job: an earlier one where the
  /// idempotency key has made one. Errors: those of the stores.
  Result<Job> Submit(const SpoolFile& upload, const Submission& submission);

  /// As JobStore::FindEarlier has it.
  Result<std::optional<Job>> FindEarlier(const Submission& submission);

  Result<Job> Find(const std::string& id);
  Result<JobPage> List(const JobQuery& query);
  /// For who waits for changes of the job: nullptr where as many do as may.
  std::unique_ptr<JobChanges::Watch> Watch(const std::string& id, const std::string& client) {
    return changes_->Add(id, client);
  }
  [[nodiscard]] std::int64_t CountWatches() const { return changes_->Count(); }
  /// As the calls of these names of JobStore have it.
  Result<std::optional<DueCallback>> ClaimCallback(std::chrono::milliseconds lease);
  Result<bool> EndCallback(const DueCallback& callback, CallbackEnd end) {
    return jobs_->EndCallback(callback, end);
  }
  Result<bool> RetryCallback(const DueCallback& callback, std::chrono::milliseconds delay);
  Result<std::vector<Artifact>> Artifacts(const std::string& id) { return jobs_->Artifacts(id); }
  /// codings: in which the artifact is wanted, best first; as it is where there is no such copy.
  /// Errors: kNotFound; kIo "result-corrupt" where the object is missing or damaged; "storage".
  Result<OpenArtifact> Open(const std::string& id, const std::string& name,
                            std::span<const Coding> codings = {});
  /// Dismisses the job, stops its worker and removes its objects: soon, where results of another
  /// are just being stored. Errors: kNotFound.
  Result<Job> Dismiss(const std::string& id);

  /// What accepting and running jobs depends on: the service is ready if all succeed. Writes to the
  /// disk and to the store.
  std::vector<ReadinessCheck> CheckReady();
  Result<UnfinishedJobs> CountUnfinished() { return jobs_->CountUnfinished(); }
  /// Room on the disk of the data folder.
  [[nodiscard]] Result<std::int64_t> FreeBytes() const;

  /// The memory of workers and probes.
  [[nodiscard]] const MemoryPlan& Memory() const { return memory_; }
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
  JobService(JobServiceOptions options, const MemoryPlan& memory, DataDirectory directory,
             Stores stores);
  [[nodiscard]] QueueBounds Bounds() const;
  /// nullptr where it is missing or damaged. Errors: of the storage, which may have it.
  Result<std::shared_ptr<VerifiedObject>> OpenSound(const StoredObject& stored);
  Status SortOut();
  void Begin();
  void SetExpiry(Job& job) const;
  /// The job as DELETE leaves it. Needs no free byte of the disk while there is a reserve.
  Result<Job> DismissWithReserve(const std::string& id);

  MemoryPlan memory_;
  JobServiceOptions options_;  // limits as memory_ has them
  DataDirectory directory_;
  std::shared_ptr<JobChanges> changes_;
  std::unique_ptr<JobStore> jobs_;
  std::unique_ptr<ObjectStore> objects_;
  ObjectCollector collector_;
  ObjectVerifier verifier_;
  StorageHealth health_;
  DiskReserve reserve_;
  UploadService uploads_;
  std::atomic<bool> draining_{false};
  UploadProbe probe_;
  JobRunner runner_;
  std::unique_ptr<JobEngine> engine_;
  std::unique_ptr<Housekeeper> housekeeper_;
};

}  // namespace farhorizon

#include "service/jobs/job_service.h"

#include <algorithm>

#include "service/clock.h"
#include "service/jobs/end_mark.h"
#include "service/jobs/open_stores.h"
#include "service/jobs/storage_file.h"
#include "service/jobs/sync_failure.h"
#include "service/log.h"
#include "service/machine_memory.h"
#include "service/metrics.h"

namespace farhorizon {

namespace {

namespace fs = std::filesystem;

Error Draining() {
  return {ErrorCode::kResourceExhausted, "the service is being stopped; try again soon",
          "draining"};
}

NewJob NewJobOf(const Submission& submission, const StoredObject& input) {
  return {submission.filename, submission.parameters,      input.sha256,
          input.bytes,         submission.idempotency_key, submission.assumptions,
          submission.client,   submission.terms,           submission.cost,
          submission.process,  submission.answer,          submission.owner,
          submission.source,   submission.subscriber};
}

MemoryWishes WishesOf(const JobServiceOptions& options) {
  return {MachineMemoryBytes(),       options.memory_bytes, options.runner.limits.memory_bytes,
          options.probe.memory_bytes, options.workers,      options.probe.at_once};
}

JobServiceOptions Within(const MemoryPlan& memory, JobServiceOptions options) {
  options.runner.limits.memory_bytes = memory.job_bytes;
  options.probe.memory_bytes = memory.probe_bytes;
  options.probe.at_once = memory.probes;
  return options;
}

}  // namespace

Result<std::unique_ptr<JobService>> JobService::Open(JobServiceOptions options) {
  const Result<MemoryPlan> memory = PlanMemory(WishesOf(options));
  if (!memory) return memory.error();
  Result<DataDirectory> directory = OpenDataDirectory(options.data);
  if (!directory) return std::move(directory.error());
  Result<Stores> stores = OpenStores(*directory, options.store, 2 * options.min_free_bytes);
  if (!stores) return std::move(stores.error());
  std::unique_ptr<JobService> service(
      new JobService(std::move(options), *memory, *std::move(directory), *std::move(stores)));
  Status sorted = service->SortOut();
  if (!sorted) return std::move(sorted.error());
  service->Begin();
  return service;
}

JobService::JobService(JobServiceOptions options, const MemoryPlan& memory, DataDirectory directory,
                       Stores stores)
    : memory_(memory),
      options_(Within(memory, std::move(options))),
      directory_(std::move(directory)),
      changes_(std::make_shared<JobChanges>(options_.max_watches)),
      jobs_(std::move(stores.jobs)),
      objects_(std::move(stores.objects)),
      collector_(*jobs_, *objects_),
      health_(directory_, *jobs_, *objects_, options_.min_free_bytes),
      reserve_(directory_.Reserve()),
      uploads_({*jobs_, *objects_, collector_, directory_.Spool()}, options_.uploads),
      probe_(directory_.Work(), options_.probe, options_.runner),
      runner_({*jobs_, *objects_, collector_, health_}, directory_.Work(), options_.runner) {
  jobs_->OnChange([changes = changes_](const std::string& id) { changes->Tell(id); });
}

JobService::~JobService() { Stop(); }

Status JobService::SortOut() {
  const auto recover = [this] { return jobs_->RecoverRunning(directory_.previous_end, NowMs()); };
  Result<std::int64_t> recovered = recover();
  if (!recovered && recovered.error().kind == "no-space" && reserve_.Release()) {
    recovered = recover();
  }
  if (!recovered) return std::move(recovered.error());
  if (*recovered > 0) Log(LogLevel::kWarning, "jobs taken up again", {{"jobs", *recovered}});
  // Where others put objects now, which of them are strays nobody can tell.
  if (jobs_->LeaseTime()) return Ok{};
  Result<SortedObjects> sorted = collector_.SortOut();
  if (!sorted) {
    // Nothing is lost by it, and results can be read from a disk that is full.
    if (!IsMachineFault(sorted.error())) return std::move(sorted.error());
    Log(LogLevel::kWarning, "objects are left", {{"error", sorted.error().message}});
    return Ok{};
  }
  if (sorted->strays > 0 || sorted->taken_back > 0) {
    Log(LogLevel::kWarning, "objects that no job of this database knows were set aside",
        {{"objects", sorted->strays},
         {"taken_back", sorted->taken_back},
         {"folder", (directory_.Objects() / "stray").string()}});
  }
  return Ok{};
}

void JobService::Begin() {
  MarkRunning(directory_.lock.get());
  engine_ = std::make_unique<JobEngine>(*jobs_, runner_,
                                        EngineLimits{options_.workers, memory_.jobs_bytes});
  housekeeper_ = std::make_unique<Housekeeper>(Household{directory_, *jobs_, collector_, uploads_,
                                                         reserve_, options_.retention,
                                                         [this] { engine_->StopTaking(); }});
}

void JobService::Stop() {
  if (engine_) engine_->Stop();
  if (!housekeeper_) return;
  housekeeper_->Stop();
  MarkOrderly(directory_.lock.get());
}

void JobService::MarkEnd() {
  MarkFatalSignals(directory_.lock.get());
  BeforeSyncEnd([lock = directory_.lock.get()] { MarkOrderly(lock); });
}

Result<std::optional<Job>> JobService::FindEarlier(const Submission& submission) {
  return jobs_->FindEarlier(NewJobOf(submission, {}), NowMs());
}

Result<std::optional<DueCallback>> JobService::ClaimCallback(std::chrono::milliseconds lease) {
  return jobs_->ClaimCallback(lease, NowMs());
}

Result<bool> JobService::RetryCallback(const DueCallback& callback,
                                       std::chrono::milliseconds delay) {
  return jobs_->RetryCallback(callback, delay, NowMs());
}

QueueBounds JobService::Bounds() const {
  const std::int64_t all = options_.max_waiting;
  const std::int64_t own = options_.max_waiting_per_client;
  return {all, own > 0 ? own : all - all / 8};
}

Status JobService::CheckUploadRoom() const {
  return draining_ ? Status(Draining()) : health_.CheckRoom();
}

Status JobService::CheckRoom(const std::string& client) {
  Status room = CheckUploadRoom();
  if (!room) return room;
  return jobs_->CheckQueue(client, Bounds());
}

std::vector<ReadinessCheck> JobService::CheckReady() {
  return {{"accepting", draining_ ? Status(Draining()) : Status(Ok{})},
          {"room", health_.CheckRoom()},
          {"storage", health_.CheckWrites()}};
}

Result<std::int64_t> JobService::FreeBytes() const {
  Result<std::int64_t> own = farhorizon::FreeBytes(directory_.root);
  if (!own) return own;
  Result<DiskRoom> room = objects_->Room();
  if (!room) return std::move(room.error());
  return std::min(*own, room->bytes);
}

void JobService::SetExpiry(Job& job) const {
  const std::int64_t seconds = options_.retention.seconds;
  if (job.finished_ms && seconds > 0) job.expires_ms = *job.finished_ms + seconds * 1000;
}

Result<Job> JobService::Find(const std::string& id) {
  Result<Job> job = jobs_->Find(id);
  if (job) SetExpiry(*job);
  return job;
}

Result<JobPage> JobService::List(const JobQuery& query) {
  Result<JobPage> page = jobs_->List(query);
  if (!page) return page;
  for (Job& job : page->jobs) SetExpiry(job);
  return page;
}

Result<Job> JobService::Submit(const SpoolFile& upload, const Submission& submission) {
  auto pin = collector_.Pin();
  if (!pin) return std::move(pin.error());
  Result<StoredObject> stored = objects_->PutFile(upload.path());
  if (!stored) return std::move(stored.error());
  Result<Job> inserted = jobs_->Insert(NewJobOf(submission, *stored), Bounds(), NowMs());
  if (inserted) objects_->Keep({stored->sha256});
  if (inserted && !submission.upload.empty()) {
    const Status settled = uploads_.Settle(submission.upload, *stored);
    if (!settled) Log(LogLevel::kWarning, "parts are left", {{"error", settled.error().message}});
  }
  pin->reset();
  if (inserted) {
    engine_->Wake();
    return inserted;
  }
  Status removed = collector_.RemoveUnlessPinned({stored->sha256});
  if (!removed) Log(LogLevel::kWarning, "an object is left", {{"error", removed.error().message}});
  return inserted;
}

Result<std::shared_ptr<VerifiedObject>> JobService::OpenSound(const StoredObject& stored) {
  // Twice, for a copy of it on this machine may be damaged, and the object not.
  for (int tries = 0; tries < 2; ++tries) {
    Result<OpenObject> object = objects_->Open(stored.sha256);
    if (!object && IsMachineFault(object.error())) return std::move(object.error());
    if (!object) break;
    if (object->bytes == stored.bytes) {
      auto verified = verifier_.Open(*std::move(object), stored.sha256);
      if (verified) return verified;
    }
    objects_->Distrust(stored.sha256);
  }
  return std::shared_ptr<VerifiedObject>();
}

Result<OpenArtifact> JobService::Open(const std::string& id, const std::string& name,
                                      std::span<const Coding> codings) {
  Result<std::vector<Artifact>> artifacts = jobs_->Artifacts(id);
  if (!artifacts) return std::move(artifacts.error());
  for (Artifact& artifact : *artifacts) {
    if (artifact.name != name) continue;
    for (const Coding coding : codings) {
      const auto copy = coding == Coding::kZstd ? artifact.zstd : artifact.gzip;
      if (!copy) continue;
      auto object = OpenSound(*copy);
      if (!object) return std::move(object.error());
      // A lost copy is no lost result.
      if (*object) return OpenArtifact{std::move(artifact), coding, *copy, *std::move(object)};
    }
    const StoredObject own{artifact.sha256, artifact.bytes};
    auto object = OpenSound(own);
    if (!object) return std::move(object.error());
    if (*object) {
      return OpenArtifact{std::move(artifact), Coding::kIdentity, own, *std::move(object)};
    }
    // If the job is gone by now, it was dismissed between the two calls. If not, the object is
    // lost.
    Result<Job> job = jobs_->Find(id);
    if (!job) return std::move(job.error());
    CountCorruptResult();
    return ResultCorrupt();
  }
  return Error{ErrorCode::kNotFound, "the job has no artifact of this name", "no-such-output"};
}

Result<Job> JobService::DismissWithReserve(const std::string& id) {
  Result<Job> dismissed = jobs_->Dismiss(id, NowMs());
  if (dismissed || dismissed.error().kind != "no-space" || !reserve_.Release()) return dismissed;
  return jobs_->Dismiss(id, NowMs());
}

Result<Job> JobService::Dismiss(const std::string& id) {
  Result<Job> before = jobs_->Find(id);
  if (!before) return before;
  Result<std::vector<Artifact>> artifacts = jobs_->Artifacts(id);
  if (!artifacts) return std::move(artifacts.error());
  Result<Job> dismissed = DismissWithReserve(id);
  if (!dismissed) return dismissed;
  engine_->Cancel(id);
  std::vector<std::string> names = ObjectsOf(*artifacts);
  names.push_back(before->input_sha256);
  Status removed = collector_.RemoveUnlessPinned(names);
  if (!removed) Log(LogLevel::kWarning, "objects are left", {{"error", removed.error().message}});
  SetExpiry(*dismissed);
  return dismissed;
}

SandboxLayers JobService::ActiveSandbox() const {
  return options_.runner.spawner ? options_.runner.spawner->Layers() : SandboxLayers{};
}

void JobService::Drain() {
  draining_ = true;
  engine_->StopTaking();
}

}  // namespace farhorizon

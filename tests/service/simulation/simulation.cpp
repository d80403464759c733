#include "tests/service/simulation/simulation.h"

#include <algorithm>

#include "service/jobs/sqlite_job_store.h"

namespace farhorizon {

namespace {

constexpr QueueBounds kBounds{6, 4};
constexpr std::int64_t kLongestPatienceMs = 600'000;  // service/jobs/sql_claim.cpp
constexpr std::int64_t kMostProcessCrashes = 3;       // service/jobs/sql_queue.cpp
constexpr std::size_t kNotesKept = 25;

}  // namespace

Simulation::Simulation(std::uint32_t seed, const std::filesystem::path& below)
    : random_(seed), unstable_(Draw(4) == 0), folder_(below) {
  Open();
}

void Simulation::Open() {
  jobs_.reset();
  auto opened = OpenSqliteJobStore(folder_ / "jobs.sqlite");
  Demand(static_cast<bool>(opened), "the store opens");
  if (opened) jobs_ = *std::move(opened);
  turns_ = 0;
  latest_ms_ = 0;
  for (const auto& [id, known] : known_) latest_ms_ = std::max(latest_ms_, known.job.updated_ms);
}

std::int64_t Simulation::Now() {
  latest_ms_ = std::max(latest_ms_, now_ms_);
  return now_ms_;
}

std::string Simulation::Run(int steps) {
  for (int i = 0; i < steps && broken_.empty(); ++i) Step();
  if (broken_.empty()) Drain();
  if (broken_.empty()) return broken_;
  std::string report = "broken: " + broken_ + "\nthe last steps:\n";
  for (const std::string& note : notes_) report += "  " + note + "\n";
  return report;
}

void Simulation::Step() {
  now_ms_ += Draw(20'000);
  if (unstable_ && Draw(8) == 0) return Restart();
  switch (Draw(20)) {
    case 0:
    case 1:
    case 2:
    case 3:
    case 4:
      return Submit();
    case 5:
    case 6:
    case 7:
    case 8:
      return Claim();
    case 9:
      return Dismiss();
    case 10:
      return Draw(2) == 0 ? Expire() : Collect();
    case 11:
      return FailOverdue();
    case 12:
      return Draw(3) == 0 ? Restart() : Collect();
    case 13:
      // An hour back or forth, as of an operator or a wrong time server.
      now_ms_ += (static_cast<std::int64_t>(Draw(7200)) - 3600) * 1000 * (Draw(4) == 0 ? 1 : 0);
      return Note("the clock says " + std::to_string(now_ms_));
    case 14:
      // A submission or a run that ended between its objects and its row.
      objects_.Put(DrawObject());
      return CheckAll({});
    default:
      return Work();
  }
}

void Simulation::Submit() {
  NewJob job{"dem.tif", {}, DrawObject(), 5, {}};
  job.client = std::string(1, static_cast<char>('a' + Draw(3)));
  job.terms.priority = static_cast<Priority>(Draw(3));
  if (Draw(4) == 0) job.terms.deadline_seconds = 1 + Draw(200);
  job.cost.memory_bytes = Draw(3) == 0 ? 0 : Draw(1300);
  if (Draw(3) == 0) {
    // Of one key, nearly always the same job.
    const std::uint32_t key = Draw(5);
    job.idempotency_key = "key" + std::to_string(key);
    if (Draw(5) != 0) {
      job.input_sha256 = std::string(64, "01234"[key]);
      job.terms = {};
    }
  }
  const std::int64_t all = Waiting(nullptr);
  const std::int64_t own = Waiting(&job.client);
  objects_.Put(job.input_sha256);
  const Result<Job> stored = jobs_->Insert(job, kBounds, Now());
  if (!stored) {
    Note("submit of " + job.client + " refused: " + std::string(stored.error().kind));
    const bool full = all >= kBounds.all || own >= kBounds.of_client;
    Demand(full || stored.error().kind == "idempotency-key-reused", "only a full queue refuses");
    return CheckAll({});
  }
  objects_.Keep({job.input_sha256});
  Note("submit of " + job.client + " with " + job.idempotency_key.value_or("no key") + ": " +
       stored->id);
  if (!known_.contains(stored->id)) {
    Demand(all < kBounds.all && own < kBounds.of_client, "the bound of the queue holds");
    Demand(stored->state == JobState::kAccepted, "a new job is accepted");
    if (!known_.empty()) Demand(stored->id > known_.rbegin()->first, "ids grow");
    known_[stored->id].job = *stored;
  }
  if (job.idempotency_key) {
    const auto earlier = keys_.find(*job.idempotency_key);
    const bool there = earlier != keys_.end() && known_.contains(earlier->second);
    Demand(!there || earlier->second == stored->id, "I6: one key makes one job");
    keys_[*job.idempotency_key] = stored->id;
  }
  CheckAll({});
}

void Simulation::Claim() {
  std::int64_t free_bytes = kMostMemory;
  if (Running(nullptr) > 0) free_bytes = Draw(kMostMemory + 1);
  const auto claimed = jobs_->ClaimNext(Now(), {free_bytes, kMostMemory});
  Demand(static_cast<bool>(claimed), "a claim is answered");
  if (!claimed || !*claimed) {
    Note("claim with " + std::to_string(free_bytes) + ": none");
    CheckNoClaim(free_bytes);
    return CheckAll({});
  }
  const Job& job = **claimed;
  Note("claim with " + std::to_string(free_bytes) + ": " + job.id);
  CheckClaim(job, free_bytes);
  ++turns_;
  workers_.push_back({job.id, job.run});
  CheckAll({job.id});
  Demand(known_[job.id].job.state == JobState::kRunning, "a claimed job runs");
}

void Simulation::Work() {
  if (workers_.empty()) return;
  // Workers whose lease is lost stay in the list: they write late.
  const std::size_t newest = workers_.size() - 1;
  const std::size_t at = Draw(2) == 0 ? newest : Draw(static_cast<std::uint32_t>(newest + 1));
  Worker worker = workers_[at];
  if (Draw(12) == 0) worker.run += Draw(2) == 0 ? 1 : -1;  // a lie
  Report(worker, static_cast<int>(Draw(9)));
}

void Simulation::Report(const Worker& worker, int deed) {
  const auto found = known_.find(worker.id);
  const bool leased = found != known_.end() && found->second.job.state == JobState::kRunning &&
                      found->second.job.run == worker.run;
  Result<bool> done = false;
  switch (deed) {
    case 0:
    case 1:
      done = jobs_->ReportProgress(worker.id, worker.run, static_cast<int>(Draw(101)), "at work",
                                   Now());
      break;
    case 2:
      done = jobs_->ReportAssumptions(worker.id, worker.run, {}, Now());
      break;
    case 3:
      done = jobs_->Fail(worker.id, worker.run, {ErrorCode::kInvalidArgument, "bad DEM"}, Now());
      break;
    case 4:
      done = CrashOnce(worker);
      break;
    case 5: {
      const std::int64_t delay_ms = Draw(30'000);
      done = jobs_->Postpone(worker.id, worker.run, delay_ms, Now());
      if (leased) found->second.not_before_ms = latest_ms_ + delay_ms;
      break;
    }
    case 6:
      done = jobs_->RequeueWithMemory(worker.id, worker.run, 1 + Draw(1300), Now());
      break;
    default:
      done = Publish(worker);
  }
  Note("deed " + std::to_string(deed) + " of " + worker.id + " run " + std::to_string(worker.run) +
       (leased ? "" : ", which is over"));
  Demand(done && *done == leased, "who has the lease, and nobody else, changes a job");
  CheckAll(leased ? std::set{worker.id} : std::set<std::string>{});
}

// As RunEnding: a worker's second crash fails the job.
Result<bool> Simulation::CrashOnce(const Worker& worker) {
  const auto found = known_.find(worker.id);
  if (found != known_.end() && found->second.job.crash_count >= 1) {
    return jobs_->Fail(worker.id, worker.run, {ErrorCode::kIo, "crashed"}, Now());
  }
  const auto reason = Draw(3) == 0 ? RequeueReason::kServiceStopped : RequeueReason::kWorkerCrashed;
  return jobs_->Requeue(worker.id, worker.run, reason, Now());
}

Result<bool> Simulation::Publish(const Worker& worker) {
  std::vector<Artifact> artifacts;
  for (std::uint32_t i = 0; i <= Draw(2); ++i) {
    artifacts.push_back({"artifact" + std::to_string(i), "a/b", 5, DrawObject()});
    if (Draw(3) == 0) artifacts.back().gzip = StoredObject{DrawObject(), 3};
    if (Draw(3) == 0) artifacts.back().zstd = StoredObject{DrawObject(), 2};
  }
  for (const std::string& name : ObjectsOf(artifacts)) objects_.Put(name);
  Result<bool> done = jobs_->Publish(worker.id, worker.run, artifacts, {}, Now());
  if (done && *done) {
    objects_.Keep(ObjectsOf(artifacts));
    if (known_.contains(worker.id)) known_[worker.id].artifacts = ObjectsOf(artifacts);
  }
  return done;
}

void Simulation::Dismiss() {
  if (known_.empty()) return;
  auto at = known_.begin();
  std::advance(at, Draw(static_cast<std::uint32_t>(known_.size())));
  const std::string id = at->first;
  const bool finished = IsTerminal(at->second.job.state);
  Note("dismiss " + id);
  const Result<Job> dismissed = jobs_->Dismiss(id, Now());
  Demand(dismissed && dismissed->state == JobState::kDismissed, "a dismissed job is dismissed");
  if (finished) known_.erase(at);
  if (!finished && !broken_.empty()) return;
  CheckAll({id});
  if (!finished) Demand(known_[id].job.state == JobState::kDismissed, "its row says so");
}

void Simulation::Expire() {
  const Retention retention{static_cast<std::int64_t>(Draw(600)),
                            static_cast<std::int64_t>(Draw(9)),
                            static_cast<std::int64_t>(Draw(100))};
  Note("expire");
  Demand(static_cast<bool>(jobs_->RemoveExpired(retention, now_ms_)), "expired jobs go");
  CheckAll({}, true);
}

void Simulation::FailOverdue() {
  Note("fail overdue jobs");
  const auto ids = jobs_->FailOverdue(Now());
  if (!ids) return Demand(false, "deadlines are looked after");
  for (const std::string& id : *ids) {
    Demand(known_[id].job.state == JobState::kAccepted &&
               known_[id].job.deadline_ms.value_or(latest_ms_ + 1) <= latest_ms_,
           "only what waits and is overdue fails so");
  }
  CheckAll({ids->begin(), ids->end()});
}

void Simulation::Collect() {
  Note("collect objects");
  ObjectCollector collector(*jobs_, objects_);
  Demand(static_cast<bool>(collector.RemoveGarbage()), "garbage goes");
  Demand(static_cast<bool>(collector.RemoveUnacknowledged()), "what nobody has named goes");
  CheckNoOrphans();
  CheckAll({});
}

void Simulation::Restart() {
  auto end = static_cast<PreviousEnd>(Draw(3));
  if (unstable_ && Draw(2) == 0) end = PreviousEnd::kCrashed;
  Note("restart after end " + std::to_string(static_cast<int>(end)));
  Open();
  if (!broken_.empty()) return;
  const auto sorted = ObjectCollector(*jobs_, objects_).SortOut();
  Demand(sorted && sorted->strays == 0, "no object of the store's own is a stray");
  CheckNoOrphans();
  std::set<std::string> ran;
  std::map<std::string, bool> poisonous;
  for (auto& [id, known] : known_) {
    if (known.job.state != JobState::kRunning) continue;
    ran.insert(id);
    known.process_crashes += end == PreviousEnd::kCrashed ? 1 : 0;
    poisonous[id] = known.process_crashes >= kMostProcessCrashes;
  }
  Demand(static_cast<bool>(jobs_->RecoverRunning(end, Now())), "running jobs are recovered");
  CheckAll(ran);
  for (const std::string& id : ran) {
    const JobState expected = poisonous[id] ? JobState::kFailed : JobState::kAccepted;
    Demand(known_[id].job.state == expected, "a restart makes of a job what its crashes say");
  }
}

void Simulation::Drain() {
  Note("drain");
  // Whatever was postponed may start by then, and whatever waits for room has lost its patience.
  for (int i = 0; i < 1000 && broken_.empty() && Waiting(nullptr) + Running(nullptr) > 0; ++i) {
    now_ms_ = std::max(now_ms_, latest_ms_) + kLongestPatienceMs;
    FailOverdue();
    Claim();
    if (!broken_.empty() || workers_.empty()) continue;
    const std::vector<Worker> workers = std::move(workers_);
    workers_.clear();
    for (const Worker& worker : workers) {
      if (broken_.empty()) Report(worker, Draw(4) == 0 ? 3 : 7);
    }
  }
  Demand(Waiting(nullptr) + Running(nullptr) == 0, "I1: every accepted job ends");
  Collect();
}

void Simulation::Note(const std::string& step) {
  notes_.push_back(step);
  if (notes_.size() > kNotesKept) notes_.pop_front();
}

void Simulation::Demand(bool holds, const std::string& what) {
  if (!holds && broken_.empty()) broken_ = what;
}

}  // namespace farhorizon

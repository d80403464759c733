// A job store against its slow twin, through random lives of a service: submissions, workers that
// end in every way, late ones, dismissals, retention, restarts, and a clock that jumps both ways.
//
//   SIMULATION_SEEDS=27 service_test --gtest_filter='JobStoreSimulation.*'           one life again
//   SIMULATION_SEEDS=1-100000 service_test --gtest_filter='JobStoreSimulation.*'     many
#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "service/jobs/sqlite_job_store.h"
#include "tests/service/simulation/queue_model.h"
#include "tests/support/effort.h"
#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

constexpr std::int64_t kHourMs = 3'600'000;

/// One life of a service on a store of its own.
class Life {
 public:
  Life(std::uint64_t seed, const std::filesystem::path& below)
      : random_(seed), folder_(below), file_(folder_ / "jobs.sqlite") {
    Open();
  }

  /// True as long as nothing is wrong.
  bool Step() {
    const std::vector<std::pair<int, std::function<void()>>> deeds = {
        {5, [this] { Submit(); }},  {5, [this] { Claim(); }},    {8, [this] { Worker(); }},
        {1, [this] { Dismiss(); }}, {1, [this] { Overdue(); }},  {1, [this] { Expire(); }},
        {1, [this] { Restart(); }}, {1, [this] { JumpClock(); }}};
    int all = 0;
    for (const auto& deed : deeds) all += deed.first;
    int drawn = Draw(all);
    now_ms_ += Draw(3000);
    for (const auto& [weight, deed] : deeds) {
      if ((drawn -= weight) < 0) {
        deed();
        break;
      }
    }
    return model_.faults().empty();
  }

  /// Works off what waits: each job has to end.
  void Drain() {
    for (int i = 0; i < 1000 && model_.Count(JobState::kAccepted) > 0; ++i) {
      now_ms_ += 60'000;
      Overdue();
      Claim({});
      for (const std::string& id : Ids(JobState::kRunning)) End(id, model_.At(id).last.run, 0);
    }
    if (model_.Count(JobState::kAccepted) > 0) model_.Fault("I1: a job never ends");
    LookAtAll();
  }

  [[nodiscard]] std::string Faults() const {
    std::string text;
    for (const std::string& fault : model_.faults()) text += "\n  " + fault;
    if (text.empty()) return text;
    for (std::size_t i = deeds_.size() - std::min<std::size_t>(12, deeds_.size());
         i < deeds_.size(); ++i) {
      text += "\n    after: " + deeds_[i];
    }
    return text;
  }

 private:
  int Draw(int below) { return static_cast<int>(random_() % static_cast<unsigned>(below)); }
  void Note(const std::string& deed) { deeds_.push_back(deed); }
  void Open() {
    store_.reset();
    auto opened = OpenSqliteJobStore(file_);
    ASSERT_TRUE(opened) << opened.error().message;
    store_ = *std::move(opened);
  }
  [[nodiscard]] std::vector<std::string> Ids(JobState state) const {
    std::vector<std::string> ids;
    for (const auto& [id, job] : model_.jobs()) {
      if (job.last.state == state) ids.push_back(id);
    }
    return ids;
  }
  std::string AnyId() {
    if (model_.jobs().empty()) return NewJobId(now_ms_);
    return std::next(model_.jobs().begin(), Draw(static_cast<int>(model_.jobs().size())))->first;
  }
  static std::string Object(int number) {
    return std::string(63, 'a') + std::to_string(number % 10);
  }

  void Submit() {
    NewJob job;
    job.filename = "dem.tif";
    job.input_sha256 = Object(Draw(4));
    job.input_bytes = 5;
    job.client = std::string(1, static_cast<char>('p' + Draw(3)));
    job.terms.priority = static_cast<Priority>(Draw(3));
    if (Draw(4) == 0) job.terms.deadline_seconds = 1 + Draw(7200);
    if (Draw(3) == 0) job.idempotency_key = "key-" + std::to_string(Draw(6));
    if (Draw(2) == 0) job.cost.memory_bytes = 100 * (1 + Draw(12));
    Note("submit for " + job.client + ", key " + job.idempotency_key.value_or("none"));
    const QueueBounds bounds{8, 5};
    model_.Inserted(job, bounds, store_->Insert(job, bounds, now_ms_));
  }

  void Claim() {
    MemoryRoom room{1000, 1000};
    for (const std::string& id : Ids(JobState::kRunning)) {
      const std::int64_t has = model_.At(id).sent.cost.memory_bytes;
      room.free_bytes -= has > 0 ? std::min<std::int64_t>(has, 1000) : 1000;
    }
    Claim(room);
  }
  void Claim(const MemoryRoom& room) {
    Note("claim, room " + std::to_string(room.free_bytes));
    const auto claimed = store_->ClaimNext(now_ms_, room);
    if (!claimed) return model_.Fault("claim: " + claimed.error().message);
    model_.Claimed(*claimed, room, now_ms_);
  }

  /// A worker of the job's present run, or of an earlier one that comes late.
  void Worker() {
    const std::vector<std::string> running = Ids(JobState::kRunning);
    const bool late = running.empty() || Draw(5) == 0;
    const std::string id =
        late ? AnyId() : running[static_cast<std::size_t>(Draw(static_cast<int>(running.size())))];
    const auto known = model_.jobs().find(id);
    const std::int64_t run = known == model_.jobs().end() ? 1 : known->second.last.run;
    End(id, late ? std::max<std::int64_t>(0, run - Draw(2)) : run, Draw(7));
  }
  void End(const std::string& id, std::int64_t run, int how) {
    constexpr std::array kHow = {"publish",  "fail",     "crash",      "stop",
                                 "postpone", "progress", "more memory"};
    Note(std::string(kHow.at(static_cast<std::size_t>(how))) + " run " + std::to_string(run) +
         " of " + id);
    const std::string object = Object(4 + Draw(4));
    const auto call = [&]() -> std::pair<Result<bool>, JobState> {
      switch (how) {
        case 0:
          return {store_->Publish(id, run, {{"r", "a/b", 1, object}}, {}, now_ms_),
                  JobState::kSuccessful};
        case 1:
          return {store_->Fail(id, run, {ErrorCode::kUnsupportedData, "why", "no-crs"}, now_ms_),
                  JobState::kFailed};
        case 2:
          return {store_->Requeue(id, run, RequeueReason::kWorkerCrashed, now_ms_),
                  JobState::kAccepted};
        case 3:
          return {store_->Requeue(id, run, RequeueReason::kServiceStopped, now_ms_),
                  JobState::kAccepted};
        case 4:
          return {store_->Postpone(id, run, Draw(30'000), now_ms_), JobState::kAccepted};
        case 5:
          return {store_->ReportProgress(id, run, Draw(100), "m", now_ms_), JobState::kRunning};
        default:
          return {store_->RequeueWithMemory(id, run, 500, now_ms_), JobState::kAccepted};
      }
    };
    auto [done, to] = call();
    if (!done) return model_.Fault(done.error().message);
    model_.Answered(id, run, *done);
    if (!*done || !model_.jobs().contains(id)) return Look(id);
    if (how == 0) model_.At(id).artifacts = {object};
    if (how == 6) model_.At(id).sent.cost.memory_bytes = 500;
    model_.Saw(store_->Find(id), id, to);
  }

  void Dismiss() {
    const std::string id = AnyId();
    Note("dismiss " + id);
    model_.Dismissed(id, store_->Dismiss(id, now_ms_));
    Look(id);
  }
  void Overdue() {
    Note("overdue");
    const auto failed = store_->FailOverdue(now_ms_);
    if (!failed) return model_.Fault(failed.error().message);
    for (const std::string& id : *failed) {
      if (!model_.jobs().contains(id) || !model_.At(id).last.deadline_ms) {
        model_.Fault("a job without a deadline is overdue");
        continue;
      }
      model_.Saw(store_->Find(id), id, JobState::kFailed);
    }
    for (const std::string& id : Ids(JobState::kAccepted)) {
      if (model_.At(id).last.deadline_ms.value_or(now_ms_ + 1) <= now_ms_) {
        model_.Fault("a job is overdue and waits");
      }
    }
  }
  void Expire() {
    Note("expire");
    const Retention retention{Draw(2) == 0 ? 7200 : 0, 6, 0};
    for (;;) {
      const auto removed = store_->RemoveExpired(retention, now_ms_);
      if (!removed) return model_.Fault(removed.error().message);
      if (*removed == 0) break;
    }
    std::int64_t ended = 0;
    std::vector<std::string> gone;
    for (const auto& [id, job] : model_.jobs()) {
      if (!store_->Find(id)) {
        gone.push_back(id);
      } else if (IsTerminal(job.last.state)) {
        ++ended;
      }
    }
    for (const std::string& id : gone) model_.Gone(id);
    if (ended > retention.jobs) model_.Fault("more jobs are kept than may be");
  }

  /// The process ends: what the store has answered is there afterwards.
  void Restart() {
    const auto end = static_cast<PreviousEnd>(Draw(3));
    Note("restart, end " + std::to_string(static_cast<int>(end)));
    Open();
    const auto count = store_->RecoverRunning(end, now_ms_);
    if (!count) return model_.Fault(count.error().message);
    model_.Recovered(end, *count);
    for (const std::string& id : Ids(JobState::kRunning)) {
      model_.Saw(store_->Find(id), id,
                 model_.At(id).crashes < 3 ? JobState::kAccepted : JobState::kFailed);
    }
    LookAtAll();
  }
  void JumpClock() {
    now_ms_ += (Draw(2) == 0 ? 1 : -1) * (Draw(2) == 0 ? kHourMs : 2000);
    Note("clock " + std::to_string(now_ms_));
  }

  void Look(const std::string& id) { model_.Saw(store_->Find(id), id); }
  void LookAtAll() {
    std::vector<std::string> ids;
    for (const auto& [id, job] : model_.jobs()) ids.push_back(id);
    for (const std::string& id : ids) Look(id);
    const auto page = store_->List({{}, {}, 1000});
    if (page->jobs.size() != ids.size()) model_.Fault("the list has other jobs");
    const auto unfinished = store_->CountUnfinished();
    if (unfinished->accepted != model_.Count(JobState::kAccepted) ||
        unfinished->running != model_.Count(JobState::kRunning)) {
      model_.Fault("unfinished jobs are miscounted");
    }
    LookAtObjects();
  }
  /// I7: what a row names is referenced, what none names any more is garbage.
  void LookAtObjects() {
    std::set<std::string> named;
    for (const auto& [id, job] : model_.jobs()) {
      named.insert(job.sent.input_sha256);
      named.insert(job.artifacts.begin(), job.artifacts.end());
    }
    for (int number = 0; number < 8; ++number) {
      if (*store_->IsReferenced(Object(number)) != named.contains(Object(number))) {
        model_.Fault("I7: a reference is wrong");
      }
    }
    const auto listed = store_->Garbage();
    const std::set<std::string> garbage(listed->begin(), listed->end());
    if (garbage != model_.garbage()) model_.Fault("I7: garbage is wrong");
  }

  std::mt19937_64 random_;
  TempDir folder_;
  std::filesystem::path file_;
  std::unique_ptr<JobStore> store_;
  QueueModel model_;
  std::int64_t now_ms_ = 1'800'000'000'000;
  std::vector<std::string> deeds_;
};

std::pair<std::uint64_t, std::uint64_t> Seeds() {
  const char* asked = std::getenv("SIMULATION_SEEDS");
  if (asked == nullptr) return {1, static_cast<std::uint64_t>(Rounds(100))};
  char* end = nullptr;
  const std::uint64_t first = std::strtoull(asked, &end, 10);
  return {first, *end == '-' ? std::strtoull(end + 1, nullptr, 10) : first};
}

TEST(JobStoreSimulation, HoldsItsInvariantsThroughAnyLife) {
  constexpr int kSteps = 80;
  // Where there is memory to write to, a sync takes no time.
  const bool memory = std::filesystem::is_directory("/dev/shm");
  const std::filesystem::path below = memory ? "/dev/shm" : std::filesystem::temp_directory_path();
  const auto [first, last] = Seeds();
  for (std::uint64_t seed = first; seed <= last; ++seed) {
    Life life(seed, below);
    int steps = 0;
    while (steps < kSteps && life.Step()) ++steps;
    if (steps == kSteps) life.Drain();
    ASSERT_EQ(life.Faults(), "") << "SIMULATION_SEEDS=" << seed << " shows it, step " << steps;
  }
}

}  // namespace
}  // namespace farhorizon

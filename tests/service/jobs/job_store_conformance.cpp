// The properties of every JobStore.
#include "tests/service/jobs/job_store_conformance.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <set>
#include <thread>

#include <gmock/gmock.h>

namespace farhorizon {
namespace {

using std::chrono::milliseconds;

TEST_P(JobStoreConformance, KeepsAJobOverAReopen) {
  const Job job = Insert();
  Reopen();
  const auto found = store_->Find(job.id);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->state, JobState::kAccepted);
  EXPECT_EQ(found->parameters, job.parameters);
  EXPECT_EQ(found->filename, "dem.tif");
  EXPECT_EQ(found->input_bytes, 5);
}

TEST_P(JobStoreConformance, TellsOfEveryChange) {
  std::mutex mutex;
  std::condition_variable news;
  std::vector<std::string> told;
  store_->OnChange([&](const std::string& id) {
    const std::lock_guard lock(mutex);
    told.push_back(id);
    news.notify_all();
  });
  // A store that several share tells later, from a thread of its own, and once at its beginning.
  store_->Listen([](StoreNews) {});
  const auto tells_of = [&](const std::string& id) {
    std::unique_lock lock(mutex);
    const bool was_told = news.wait_for(lock, std::chrono::seconds(10), [&] {
      return std::any_of(told.begin(), told.end(),
                         [&](auto& one) { return one.empty() || one == id; });
    });
    told.clear();
    return was_told;
  };
  if (store_->LeaseTime()) {
    ASSERT_TRUE(tells_of(""));
  }
  const Job job = Insert();
  Job claimed = Claim();
  EXPECT_TRUE(tells_of(job.id));
  const auto check = [&](const char* what, const Result<bool>& changed) {
    EXPECT_TRUE(changed && *changed) << what;
    EXPECT_TRUE(tells_of(job.id)) << what;
  };
  check("progress", store_->ReportProgress(job.id, claimed.run, 5, "sweep", ++time_));
  check("assumptions", store_->ReportAssumptions(job.id, claimed.run, {{"a", "b"}}, ++time_));
  check("requeue", store_->Requeue(job.id, claimed.run, RequeueReason::kServiceStopped, ++time_));
  claimed = Claim();
  EXPECT_TRUE(tells_of(job.id));
  check("memory", store_->RequeueWithMemory(job.id, claimed.run, 1 << 20, ++time_));
  claimed = Claim();
  EXPECT_TRUE(tells_of(job.id));
  check("postpone", store_->Postpone(job.id, claimed.run, 0, ++time_));
  claimed = Claim();
  EXPECT_TRUE(tells_of(job.id));
  check("failure",
        store_->Fail(job.id, claimed.run, {ErrorCode::kIo, "x", "internal-error"}, ++time_));
  EXPECT_FALSE(*store_->ReportProgress(job.id, claimed.run, 6, "sweep", ++time_));
  {
    const std::lock_guard lock(mutex);
    EXPECT_TRUE(told.empty()) << "nothing was changed";
  }
  ASSERT_TRUE(store_->Dismiss(job.id, ++time_));
  EXPECT_TRUE(tells_of(job.id)) << "removal";
  const Job other = Insert("b");
  claimed = Claim();
  EXPECT_TRUE(tells_of(other.id));
  ASSERT_TRUE(*store_->RecoverRunning(PreviousEnd::kOrderly, ++time_));
  EXPECT_TRUE(tells_of(other.id)) << "recovery";
  claimed = Claim();
  EXPECT_TRUE(tells_of(other.id));
  Succeed(claimed);
  EXPECT_TRUE(tells_of(other.id)) << "publication";
  ASSERT_EQ(*store_->RemoveExpired({1, 0, 0}, time_ + 10'000), 1);
  EXPECT_TRUE(tells_of(other.id)) << "expiry";
}

TEST_P(JobStoreConformance, HandsOutEachJobOnceOldestFirst) {
  const Job first = Insert();
  const Job second = Insert();
  EXPECT_EQ(Claim().id, first.id);
  EXPECT_EQ(Claim().id, second.id);
  const auto none = store_->ClaimNext(++time_, {});
  ASSERT_TRUE(none);
  EXPECT_FALSE(*none);
}

TEST_P(JobStoreConformance, HandsOutEachJobOnceToManyThreads) {
  constexpr int kJobs = 60;
  for (int i = 0; i < kJobs; ++i) Insert();
  std::atomic<int> claimed{0};
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&] {
      for (;;) {
        auto job = store_->ClaimNext(time_, {});
        if (!job || !*job) return;
        ++claimed;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(claimed, kJobs);
}

TEST_P(JobStoreConformance, PublishesArtifactsWithTheState) {
  Insert();
  const Job job = Claim();
  EXPECT_TRUE(store_->Artifacts(job.id)->empty());
  const std::vector<Artifact> artifacts = {
      {"b", "x/y", 1, std::string(64, 'b')},
      {"a", "x/z", 2, std::string(64, 'c'), StoredObject{std::string(64, 'd'), 1},
       StoredObject{std::string(64, 'e'), 1}}};
  ASSERT_TRUE(*store_->Publish(job.id, job.run, artifacts, {{"sweep", 1.5}}, ++time_));
  const auto found = store_->Find(job.id);
  EXPECT_EQ(found->state, JobState::kSuccessful);
  EXPECT_EQ(found->progress, 100);
  EXPECT_EQ(found->finished_ms, time_);
  EXPECT_EQ(found->timings.at("sweep"), 1.5);
  const auto stored = store_->Artifacts(job.id);
  ASSERT_EQ(stored->size(), 2U);
  EXPECT_EQ(stored->at(0).name, "a");
  ASSERT_TRUE(stored->at(0).gzip);
  EXPECT_EQ(stored->at(0).gzip->sha256, std::string(64, 'd'));
  EXPECT_EQ(stored->at(0).gzip->bytes, 1);
  ASSERT_TRUE(stored->at(0).zstd);
  EXPECT_EQ(stored->at(0).zstd->sha256, std::string(64, 'e'));
  EXPECT_EQ(stored->at(1).sha256, std::string(64, 'b'));
  EXPECT_FALSE(stored->at(1).gzip);
  EXPECT_FALSE(stored->at(1).zstd);
  for (const std::string& object : ObjectsOf(*stored)) {
    EXPECT_TRUE(*store_->IsReferenced(object));
  }
  ASSERT_TRUE(store_->Dismiss(job.id, ++time_));
  EXPECT_EQ(store_->Garbage()->size(), 5U) << "the upload, two artifacts and two copies";
}

TEST_P(JobStoreConformance, KeepsTheFailure) {
  Insert();
  const Job job = Claim();
  ASSERT_TRUE(*store_->Fail(
      job.id, job.run, {ErrorCode::kUnsupportedData, "no reference system", "no-crs"}, ++time_));
  const auto found = store_->Find(job.id);
  ASSERT_TRUE(found->failure);
  EXPECT_EQ(found->failure->code, ErrorCode::kUnsupportedData);
  EXPECT_EQ(found->failure->kind, "no-crs");
  EXPECT_EQ(found->failure->message, "no reference system");
}

std::vector<std::string> CodesOf(const Job& job) {
  std::vector<std::string> codes;
  for (const Assumption& assumption : job.assumptions) codes.push_back(assumption.code);
  return codes;
}

TEST_P(JobStoreConformance, KeepsTheAssumptionsOfTheLastRunThatHasSome) {
  using Codes = std::vector<std::string>;
  const NewJob probed{"dem.tif", {}, std::string(64, 'a'), 5, {}, {{"a", "\"é\""}}};
  ASSERT_TRUE(store_->Insert(probed, {}, ++time_));
  const Job first = Claim();
  EXPECT_EQ(CodesOf(first), Codes{"a"});
  EXPECT_EQ(first.assumptions.at(0).text, "\"é\"");
  const Assumptions two = {{"a", "x"}, {"b", "y"}};
  ASSERT_TRUE(*store_->ReportAssumptions(first.id, first.run, two, ++time_));
  ASSERT_TRUE(*store_->Requeue(first.id, first.run, RequeueReason::kWorkerCrashed, ++time_));
  EXPECT_EQ(CodesOf(*store_->Find(first.id)), (Codes{"a", "b"}));
  const Job second = Claim();
  ASSERT_TRUE(*store_->ReportAssumptions(second.id, second.run, {{"c", "z"}}, ++time_));
  ASSERT_TRUE(*store_->Publish(second.id, second.run, {}, {}, ++time_));
  Reopen();
  EXPECT_EQ(CodesOf(*store_->Find(second.id)), Codes{"c"});
}

TEST_P(JobStoreConformance, IgnoresAnEarlierRun) {
  Insert();
  const Job earlier = Claim();
  ASSERT_TRUE(*store_->Requeue(earlier.id, earlier.run, RequeueReason::kWorkerCrashed, ++time_));
  const Job later = Claim();
  EXPECT_EQ(later.id, earlier.id);
  EXPECT_EQ(later.run, earlier.run + 1);
  EXPECT_EQ(later.attempt, earlier.attempt + 1);
  EXPECT_EQ(later.crash_count, 1);
  EXPECT_FALSE(*store_->ReportProgress(earlier.id, earlier.run, 50, "late", ++time_));
  EXPECT_FALSE(*store_->ReportAssumptions(earlier.id, earlier.run, {{"a", "b"}}, ++time_));
  EXPECT_FALSE(*store_->Publish(earlier.id, earlier.run, {}, {}, ++time_));
  EXPECT_FALSE(*store_->Fail(earlier.id, earlier.run, {ErrorCode::kIo, "x"}, ++time_));
  EXPECT_FALSE(*store_->Requeue(earlier.id, earlier.run, RequeueReason::kServiceStopped, ++time_));
  EXPECT_TRUE(*store_->Publish(later.id, later.run, {}, {}, ++time_));
}

TEST_P(JobStoreConformance, ADismissedJobNeverBecomesSuccessful) {
  Insert();
  const Job job = Claim();
  EXPECT_EQ(store_->Dismiss(job.id, ++time_)->state, JobState::kDismissed);
  EXPECT_FALSE(*store_->Publish(job.id, job.run, {}, {}, ++time_));
  EXPECT_FALSE(*store_->Requeue(job.id, job.run, RequeueReason::kServiceStopped, ++time_));
  EXPECT_EQ(StateOf(job), JobState::kDismissed);
}

TEST_P(JobStoreConformance, DismissalAndPublicationHaveOneWinner) {
  for (int round = 0; round < 50; ++round) {
    Insert();
    const Job job = Claim();
    bool published = false;
    std::thread publisher([&] { published = *store_->Publish(job.id, job.run, {}, {}, time_); });
    ASSERT_TRUE(store_->Dismiss(job.id, time_));
    publisher.join();
    const auto found = store_->Find(job.id);
    // If publication was first, the dismissal removed the job; if not, the job stays dismissed.
    EXPECT_EQ(found.has_value(), !published);
    if (found) {
      EXPECT_EQ(found->state, JobState::kDismissed);
    }
  }
}

TEST_P(JobStoreConformance, RemovesAFinishedJob) {
  Insert();
  const Job job = Claim();
  const std::string object(64, 'b');
  ASSERT_TRUE(*store_->Publish(job.id, job.run, {{"a", "x/y", 1, object}}, {}, ++time_));
  EXPECT_TRUE(*store_->IsReferenced(object));
  EXPECT_EQ(store_->Dismiss(job.id, ++time_)->state, JobState::kDismissed);
  EXPECT_EQ(store_->Find(job.id).error().code, ErrorCode::kNotFound);
  EXPECT_EQ(store_->Dismiss(job.id, ++time_).error().code, ErrorCode::kNotFound);
  EXPECT_FALSE(*store_->IsReferenced(object));
  EXPECT_FALSE(*store_->IsReferenced(job.input_sha256));
}

TEST_P(JobStoreConformance, ProgressNeverFalls) {
  Insert();
  const Job job = Claim();
  ASSERT_TRUE(*store_->ReportProgress(job.id, job.run, 60, "sweep", ++time_));
  ASSERT_TRUE(*store_->ReportProgress(job.id, job.run, 40, "encode", ++time_));
  EXPECT_EQ(store_->Find(job.id)->progress, 60);
  EXPECT_EQ(store_->Find(job.id)->message, "encode");
}

TEST_P(JobStoreConformance, MakesRunningJobsAcceptedAgain) {
  const Job waiting = Insert();
  const Job running = Claim();
  Reopen();
  EXPECT_EQ(*store_->RecoverRunning(PreviousEnd::kKilled, ++time_), 1);
  EXPECT_EQ(StateOf(running), JobState::kAccepted);
  EXPECT_EQ(Claim().id, waiting.id);
}

TEST_P(JobStoreConformance, OneKeyMakesOneJob) {
  const Job first = Insert("a", "key");
  NewJob again{"dem.tif", {{"levels", "2"}}, first.input_sha256, 5, "key"};
  const auto replayed = store_->Insert(again, {}, ++time_);
  ASSERT_TRUE(replayed);
  EXPECT_EQ(replayed->id, first.id);
  again.input_sha256 = std::string(64, 'f');
  EXPECT_EQ(store_->Insert(again, {}, time_).error().kind, "idempotency-key-reused");
  again.input_sha256 = first.input_sha256;
  again.parameters = {{"levels", "3"}};
  EXPECT_EQ(store_->Insert(again, {}, time_).error().kind, "idempotency-key-reused");
  EXPECT_EQ(store_->List({{}, {}, 10})->jobs.size(), 1U);
}

TEST_P(JobStoreConformance, PagesThroughAllJobsNewestFirst) {
  std::vector<std::string> ids;
  for (int i = 0; i < 7; ++i) ids.insert(ids.begin(), Insert().id);
  std::vector<std::string> seen;
  JobQuery query{{}, {}, 3};
  for (;;) {
    const auto page = store_->List(query);
    ASSERT_TRUE(page);
    for (const Job& job : page->jobs) seen.push_back(job.id);
    if (!page->next) break;
    query.before = page->next;
    Insert();  // a job that is added between two pages is on neither
  }
  EXPECT_EQ(seen, ids);
}

TEST_P(JobStoreConformance, OwnersHaveTheirOwnListsAndIdempotencyKeys) {
  const auto insert = [&](const std::string& owner) {
    return store_
        ->Insert({"dem.tif",
                  {},
                  std::string(64, 'a'),
                  5,
                  "key",
                  {},
                  owner,
                  {},
                  {},
                  kTerrainProcess,
                  {},
                  owner},
                 {}, ++time_)
        ->id;
  };
  const std::string first = insert("ada");
  const std::string second = insert("bob");
  const std::string of_none = insert("");
  EXPECT_EQ(std::set<std::string>({first, second, of_none}).size(), 3U);
  EXPECT_EQ(insert("ada"), first);
  EXPECT_EQ(insert(""), of_none);
  EXPECT_EQ(store_->Find(second)->owner, "bob");
  const auto page = store_->List({.states = {}, .before = {}, .limit = 10, .owner = "bob"});
  ASSERT_EQ(page->jobs.size(), 1U);
  EXPECT_EQ(page->jobs[0].id, second);
  EXPECT_EQ(store_->List({.states = {JobState::kAccepted}, .before = second, .owner = "ada"})
                ->jobs.at(0)
                .id,
            first);
  EXPECT_TRUE(store_->List({.states = {}, .before = {}, .limit = 10, .owner = ""})->jobs.empty());
  EXPECT_EQ(store_->List({})->jobs.size(), 3U);
}

TEST_P(JobStoreConformance, FiltersByState) {
  Insert();
  Insert();
  Claim();
  EXPECT_EQ(store_->List({{JobState::kRunning}, {}, 10})->jobs.size(), 1U);
  EXPECT_EQ(store_->List({{JobState::kRunning, JobState::kAccepted}, {}, 10})->jobs.size(), 2U);
  EXPECT_EQ(store_->List({{JobState::kFailed}, {}, 10})->jobs.size(), 0U);
  EXPECT_EQ(store_->CountUnfinished()->accepted, 1);
}

TEST_P(JobStoreConformance, FiltersByProcessTimeAndDuration) {
  const Job first = Insert("a");
  NewJob other{"echo.json", {}, std::string(64, 'b'), 5, {}};
  other.process = kEchoProcess;
  other.answer = "as asked";
  const Job second = *store_->Insert(other, {}, time_ += 1000);
  const Job done = Claim();
  time_ += 5000;
  Succeed(done);
  const Job running = Claim();
  EXPECT_EQ(done.id, first.id);
  EXPECT_EQ(running.process, kEchoProcess);
  EXPECT_EQ(running.answer, "as asked");
  Insert("c");
  const auto count = [&](const JobQuery& query) { return store_->List(query)->jobs.size(); };
  EXPECT_EQ(count({.processes = {kEchoProcess}}), 1U);
  EXPECT_EQ(count({.processes = {kEchoProcess, kTerrainProcess}}), 3U);
  EXPECT_EQ(count({.created_from_ms = second.created_ms}), 2U);
  EXPECT_EQ(count({.created_to_ms = second.created_ms}), 2U);
  EXPECT_EQ(count({.created_from_ms = first.created_ms, .created_to_ms = first.created_ms}), 1U);
  const std::int64_t soon = *running.started_ms + 2000;
  EXPECT_EQ(count({.least_duration_ms = 0, .now_ms = soon}), 2U) << "one waits";
  EXPECT_EQ(count({.least_duration_ms = 3000, .now_ms = soon}), 1U);
  EXPECT_EQ(count({.least_duration_ms = 3000, .now_ms = soon + 1000}), 2U);
  EXPECT_EQ(count({.most_duration_ms = 3000, .now_ms = soon}), 1U);
  EXPECT_EQ(count({.least_duration_ms = 2000, .most_duration_ms = 5001, .now_ms = soon}), 2U);
}

TEST_P(JobStoreConformance, KeepsTheBoundOfTheQueueWhoeverComesAtOnce) {
  std::atomic<int> taken{0};
  std::atomic<int> full{0};
  std::vector<std::thread> threads;
  for (int i = 0; i < 8; ++i) {
    threads.emplace_back([&] {
      for (int n = 0; n < 5; ++n) {
        const auto inserted = store_->Insert({"a", {}, std::string(64, 'a'), 5, {}}, {3, 3}, time_);
        ++(inserted ? taken : full);
        if (!inserted) {
          EXPECT_EQ(inserted.error().kind, "queue-full");
        }
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(taken, 3);
  EXPECT_EQ(full, 37);
  EXPECT_EQ(store_->CheckQueue("", {3, 3}).error().kind, "queue-full");
}

TEST_P(JobStoreConformance, TellsTheOneThatSendsTooMuchFromAQueueThatIsFull) {
  const QueueBounds bounds{3, 2};
  const auto insert = [&](const std::string& client) {
    const auto inserted =
        store_->Insert({"a", {}, std::string(64, 'a'), 5, {}, {}, client}, bounds, time_);
    return inserted ? std::string("taken") : std::string(inserted.error().kind);
  };
  EXPECT_EQ(insert("greedy"), "taken");
  EXPECT_EQ(insert("greedy"), "taken");
  EXPECT_EQ(insert("greedy"), "too-many-jobs");
  EXPECT_EQ(store_->CheckQueue("greedy", bounds).error().kind, "too-many-jobs");
  EXPECT_TRUE(store_->CheckQueue("other", bounds));
  EXPECT_EQ(insert("other"), "taken");
  EXPECT_EQ(insert("other"), "queue-full");
  EXPECT_EQ(insert("greedy"), "too-many-jobs");
}

TEST_P(JobStoreConformance, AKeysJobIsFoundInAFullQueue) {
  const NewJob job{"a", {}, std::string(64, 'a'), 5, "key"};
  const auto first = store_->Insert(job, {1, 1}, time_);
  ASSERT_TRUE(first);
  EXPECT_EQ(store_->Insert(job, {1, 1}, time_)->id, first->id);
}

TEST_P(JobStoreConformance, ServesClientsInTurn) {
  std::vector<std::string> greedy;
  for (int i = 0; i < 4; ++i) greedy.push_back(InsertOf("greedy").id);
  const std::string first = InsertOf("first").id;
  const std::string second = InsertOf("second").id;
  EXPECT_EQ(Claim().id, greedy[0]) << "the oldest, while no client has had a turn";
  EXPECT_EQ(Claim().id, first) << "a client that runs less";
  const Job third = Claim();
  EXPECT_EQ(third.id, second);
  Succeed(third);
  InsertOf("second");
  EXPECT_EQ(Claim().client, "second") << "none of it runs, one of each other does";
  EXPECT_EQ(Claim().id, greedy[1]);
  EXPECT_EQ(Claim().id, greedy[2]);
}

TEST_P(JobStoreConformance, OneAtATimeClientsTakeTurnsToo) {
  for (int i = 0; i < 3; ++i) InsertOf("a");
  for (int i = 0; i < 3; ++i) InsertOf("b");
  std::string turns;
  for (int i = 0; i < 6; ++i) {
    const Job job = Claim();
    turns += job.client;
    Succeed(job);
  }
  EXPECT_EQ(turns, "ababab");
}

TEST_P(JobStoreConformance, NoTimeGoesBackWithTheClock) {
  const Job before = Insert();
  const std::int64_t late = time_;
  time_ -= 7'200'000;
  Reopen();
  const Job after = Insert();
  EXPECT_GE(after.created_ms, late);
  EXPECT_GT(after.id, before.id);
  EXPECT_EQ(store_->List({{}, {}, 1})->jobs.at(0).id, after.id) << "newest first";
  const Job job = Claim();
  EXPECT_EQ(job.id, before.id);
  EXPECT_GE(*job.started_ms, late);
  ASSERT_TRUE(*store_->ReportProgress(job.id, job.run, 10, "sweep", time_));
  EXPECT_GE(store_->Find(job.id)->updated_ms, late);
  Succeed(job);
  EXPECT_GE(*store_->Find(job.id)->finished_ms, *job.started_ms);
}

TEST_P(JobStoreConformance, AStopOfTheServiceSpendsNoAttempt) {
  Insert();
  const Job job = Claim();
  ASSERT_TRUE(*store_->Requeue(job.id, job.run, RequeueReason::kServiceStopped, ++time_));
  EXPECT_EQ(store_->Find(job.id)->attempt, 0);
  const Job again = Claim();
  EXPECT_EQ(again.attempt, 1);
  EXPECT_GT(again.run, job.run);
  Reopen();
  ASSERT_EQ(*store_->RecoverRunning(PreviousEnd::kOrderly, ++time_), 1);
  EXPECT_EQ(store_->Find(job.id)->attempt, 0);
}

TEST_P(JobStoreConformance, AFaultOfTheMachinePutsAJobOffAndSpendsNothing) {
  Insert();
  const Job job = Claim();
  ASSERT_TRUE(*store_->Postpone(job.id, job.run, 5000, ++time_));
  EXPECT_EQ(StateOf(job), JobState::kAccepted);
  const auto none = store_->ClaimNext(time_ + 4999, {});
  ASSERT_TRUE(none);
  EXPECT_FALSE(*none) << "not yet";
  time_ += 5000;
  const Job again = Claim();
  EXPECT_EQ(again.attempt, 1);
  EXPECT_EQ(again.crash_count, 0);
  EXPECT_EQ(again.retries, 1);
  ASSERT_TRUE(*store_->Postpone(again.id, again.run, 5000, ++time_));
  EXPECT_FALSE(*store_->Postpone(again.id, again.run, 5000, ++time_)) << "no longer its run";
}

TEST_P(JobStoreConformance, TheThirdCrashOfTheServiceWhileAJobRanFailsIt) {
  const Job poison = Insert();
  for (int crash = 1; crash <= 3; ++crash) {
    ASSERT_EQ(Claim().id, poison.id);
    Reopen();
    EXPECT_EQ(*store_->RecoverRunning(PreviousEnd::kCrashed, ++time_), crash < 3 ? 1 : 0);
  }
  const auto ended = store_->Find(poison.id);
  EXPECT_EQ(ended->state, JobState::kFailed);
  EXPECT_EQ(ended->failure->kind, "poison-job");
}

TEST_P(JobStoreConformance, AKillFromWithoutIsNoFaultOfAJobs) {
  const Job job = Insert();
  for (int kill = 0; kill < 20; ++kill) {
    ASSERT_EQ(Claim().id, job.id);
    Reopen();
    ASSERT_EQ(*store_->RecoverRunning(PreviousEnd::kKilled, ++time_), 1);
  }
  EXPECT_EQ(StateOf(job), JobState::kAccepted);
}

TEST_P(JobStoreConformance, WhatRanInACrashRunsAloneUntilItIsKnownWhichDidIt) {
  const Job innocent = Insert();
  const Job poison = Insert();
  const Job later = Insert();
  for (int i = 0; i < 2; ++i) Claim();
  Reopen();
  ASSERT_EQ(*store_->RecoverRunning(PreviousEnd::kCrashed, ++time_), 2);
  const Job alone = Claim();
  EXPECT_EQ(alone.id, innocent.id);
  const auto beside = store_->ClaimNext(++time_, {});
  ASSERT_TRUE(beside);
  EXPECT_FALSE(*beside);
  Succeed(alone);
  for (int crash = 0; crash < 2; ++crash) {
    ASSERT_EQ(Claim().id, poison.id);
    Reopen();
    ASSERT_TRUE(store_->RecoverRunning(PreviousEnd::kCrashed, ++time_));
  }
  EXPECT_EQ(StateOf(poison), JobState::kFailed);
  EXPECT_EQ(StateOf(innocent), JobState::kSuccessful);
  EXPECT_EQ(Claim().id, later.id);
}

TEST_P(JobStoreConformance, AJobThatMustRunAloneLetsOthersPassForAWhile) {
  const Job suspect = Insert();
  Claim();
  Reopen();
  ASSERT_TRUE(store_->RecoverRunning(PreviousEnd::kCrashed, ++time_));
  const Job running = InsertOf("another");
  storage_->Start("another");  // as a slot that took a job while the service came up
  const Job passing = InsertOf("third");
  EXPECT_EQ(Claim().id, passing.id);
  InsertOf("third");
  time_ += 600'000;
  const auto none = store_->ClaimNext(time_, {});
  ASSERT_TRUE(none);
  EXPECT_FALSE(*none) << "its patience is at an end";
  ASSERT_TRUE(*store_->Publish(running.id, 1, {}, {}, ++time_));
  ASSERT_TRUE(*store_->Publish(passing.id, 1, {}, {}, ++time_));
  EXPECT_EQ(Claim().id, suspect.id);
}

TEST_P(Choice, TakesTheHighestPriorityAndThereTheFairShare) {
  const std::string low = With({Priority::kLow}, "a");
  const std::string normal = With({}, "a");
  const std::string high = With({Priority::kHigh}, "a");
  const std::string high_too = With({Priority::kHigh}, "a");
  const std::string of_another = With({Priority::kHigh}, "b");
  EXPECT_EQ(Next(), high);
  EXPECT_EQ(Next(), of_another) << "the other client has none that runs";
  EXPECT_EQ(Next(), high_too);
  // Every fourth start goes by share and age alone.
  EXPECT_EQ(Next(), low);
  EXPECT_EQ(Next(), normal);
}

TEST_P(Choice, NoPriorityKeepsAJobWaitingForEver) {
  const std::string low = With({Priority::kLow});
  int starts = 0;
  for (std::string next; next != low; ++starts) {
    for (int i = 0; i < 3; ++i) With({Priority::kHigh}, "client " + std::to_string(i));
    next = Next();
    End(next);
    ASSERT_LT(starts, 40);
  }
}

TEST_P(Choice, TakesWhatThereIsMemoryForAndWaitsForTheLargeOneInTheEnd) {
  const std::string running = Costing(50);
  EXPECT_EQ(Next(), running);
  const std::string large = Costing(80);
  const std::string small = Costing(10);
  EXPECT_EQ(Next(50), small) << "it fits beside the one that runs";
  time_ += 600'000;
  const std::string later = Costing(10);
  EXPECT_EQ(Next(40), "") << "the large one has waited for long enough";
  End(running);
  EXPECT_EQ(Next(90), large);
  EXPECT_EQ(Next(10), later);
}

TEST_P(Choice, AJobOfUnknownCostTakesAsMuchAsOneMayHave) {
  const std::string unknown = Costing(0);
  EXPECT_EQ(Next(99), "");
  EXPECT_EQ(Next(100), unknown);
  const std::string larger = Costing(1000);  // accepted under another configuration
  EXPECT_EQ(Next(99), "");
  EXPECT_EQ(Next(100), larger);
}

TEST_P(Choice, MoreMemoryThanExpectedIsAskedForAgain) {
  const std::string id = Costing(10);
  ASSERT_EQ(Next(), id);
  ASSERT_TRUE(*store_->RequeueWithMemory(id, 1, 40, ++time_));
  EXPECT_FALSE(*store_->RequeueWithMemory(id, 1, 80, ++time_)) << "no longer its run";
  EXPECT_EQ(store_->Find(id)->cost.memory_bytes, 40);
  EXPECT_EQ(Next(39), "");
  EXPECT_EQ(Next(40), id);
  EXPECT_EQ(store_->Find(id)->crash_count, 0);
}

TEST_P(Choice, AJobThatWaitsPastItsDeadlineFailsWithoutARun) {
  const std::string late = With({Priority::kNormal, 5, 0});
  const std::string patient = With({Priority::kNormal, 600, 7});
  EXPECT_THAT(*store_->FailOverdue(++time_), testing::IsEmpty());
  time_ += 5000;
  EXPECT_EQ(Next(), patient) << "what is too late does not start";
  EXPECT_EQ(store_->Find(patient)->timeout_seconds, 7);
  EXPECT_THAT(*store_->FailOverdue(++time_), testing::ElementsAre(late));
  EXPECT_THAT(*store_->FailOverdue(++time_), testing::IsEmpty());
  const Job ended = *store_->Find(late);
  EXPECT_EQ(ended.state, JobState::kFailed);
  ASSERT_TRUE(ended.failure);
  EXPECT_EQ(ended.failure->kind, "timeout");
  EXPECT_THAT(ended.failure->message, testing::HasSubstr("the 5 seconds of its deadline"));
  EXPECT_EQ(ended.failure->message, ended.message);
  EXPECT_EQ(ended.run, 0);
  EXPECT_FALSE(ended.started_ms);
  time_ += 600'000;
  EXPECT_THAT(*store_->FailOverdue(++time_), testing::IsEmpty()) << "it runs";
}

TEST_P(Choice, AKeyWithOtherTermsIsAnotherSubmission) {
  NewJob job{"a", {}, std::string(64, 'a'), 5, "k"};
  job.terms = {Priority::kHigh, 60, 9};
  const auto first = store_->Insert(job, {}, ++time_);
  ASSERT_TRUE(first);
  EXPECT_EQ(store_->Insert(job, {}, ++time_)->id, first->id);
  for (const JobTerms& other : {JobTerms{Priority::kLow, 60, 9}, JobTerms{Priority::kHigh, 61, 9},
                                JobTerms{Priority::kHigh, 60, 8}}) {
    job.terms = other;
    EXPECT_EQ(store_->Insert(job, {}, ++time_).error().kind, "idempotency-key-reused");
  }
}

TEST_P(Expiry, IsByAge) {
  const std::string old = Done(1);
  time_ += 10'000;
  const std::string young = Done(1);
  const Job waiting = Insert();
  time_ += 9'000;
  EXPECT_EQ(Remove({0, 0, 0}), 0);
  EXPECT_EQ(Remove({20, 0, 0}), 0);
  EXPECT_EQ(Remove({10, 0, 0}), 1);
  EXPECT_EQ(Left(), (std::vector<std::string>{young, waiting.id}));
  EXPECT_EQ(store_->Garbage()->size(), 2U);
}

TEST_P(Expiry, IsByNumberOldestFirst) {
  std::vector<std::string> jobs;
  for (int i = 0; i < 5; ++i) jobs.push_back(Done(1));
  EXPECT_EQ(Remove({0, 2, 0}), 3);
  EXPECT_EQ(Left(), (std::vector<std::string>{jobs[3], jobs[4]}));
  EXPECT_EQ(Remove({0, 2, 0}), 0);
}

TEST_P(Expiry, IsByBytesOldestFirst) {
  std::vector<std::string> jobs;
  for (int i = 0; i < 4; ++i) jobs.push_back(Done(95));  // and an upload of 5
  EXPECT_EQ(Remove({0, 0, 400}), 0);
  EXPECT_EQ(Remove({0, 0, 250}), 2);
  EXPECT_EQ(Left(), (std::vector<std::string>{jobs[2], jobs[3]}));
  EXPECT_EQ(Remove({0, 0, 250}), 0);
}

// The outbox of calls to subscribers.

const Subscriber kWhom = {"http://a/done", "http://a/begun", "http://a/failed"};

TEST_P(Outbox, TellsOfTheStartOnceAndOfTheEnd) {
  EXPECT_EQ(Due(), "");
  InsertFor(kWhom);
  EXPECT_EQ(Due(), "") << "nothing has happened";
  Job job = Claim();
  EXPECT_EQ(Due(), "in-progress http://a/begun 1");
  EXPECT_EQ(Due(), "") << "it is claimed";
  ASSERT_TRUE(*store_->EndCallback(*last_, CallbackEnd::kDelivered));
  ASSERT_TRUE(*store_->Requeue(job.id, job.run, RequeueReason::kServiceStopped, ++time_));
  EXPECT_EQ(Due(), "");
  job = Claim();
  EXPECT_EQ(Due(), "") << "it was told of";
  Succeed(job);
  EXPECT_EQ(Due(), "success http://a/done 1");
  EXPECT_EQ(last_->job_id, job.id);
  ASSERT_TRUE(*store_->EndCallback(*last_, CallbackEnd::kDelivered));
  EXPECT_FALSE(*store_->EndCallback(*last_, CallbackEnd::kDelivered)) << "for good";
  EXPECT_EQ(Due(), "");
}

TEST_P(Outbox, DropsTheStartOnceTheJobHasEnded) {
  InsertFor(kWhom);
  const Job job = Claim();
  Succeed(job);
  EXPECT_EQ(Due(), "success http://a/done 1");
  EXPECT_EQ(Due(), "");
}

TEST_P(Outbox, AStartThatIsClaimedIsOvertakenByTheEnd) {
  InsertFor(kWhom);
  const Job job = Claim();
  EXPECT_EQ(Due(), "in-progress http://a/begun 1");
  const DueCallback begun = *last_;
  Succeed(job);
  EXPECT_FALSE(*store_->RetryCallback(begun, milliseconds(0), ++time_));
  EXPECT_EQ(Due(), "success http://a/done 1");
}

TEST_P(Outbox, TellsOfEveryWayInWhichAJobFails) {
  const std::string expected = "failure http://a/failed 1";
  InsertFor(kWhom);
  Job job = Claim();
  ASSERT_TRUE(*store_->Fail(job.id, job.run, {ErrorCode::kIo, "x", "internal-error"}, ++time_));
  EXPECT_EQ(Due(), expected) << "failed";
  job = InsertFor(kWhom);
  ASSERT_TRUE(store_->Dismiss(job.id, ++time_));
  EXPECT_EQ(Due(), expected) << "dismissed while it waited";
  InsertFor(kWhom);
  job = Claim();
  ASSERT_TRUE(store_->Dismiss(job.id, ++time_));
  EXPECT_EQ(Due(), expected) << "dismissed while it ran";
  InsertFor(kWhom, {.deadline_seconds = 1});
  time_ += 2000;
  ASSERT_EQ(store_->FailOverdue(time_)->size(), 1U);
  EXPECT_EQ(Due(), expected) << "past its deadline";
  InsertFor(kWhom);
  for (int i = 0; i < 3; ++i) {
    Claim();
    ASSERT_EQ(*store_->RecoverRunning(PreviousEnd::kCrashed, ++time_), i < 2 ? 1 : 0);
  }
  EXPECT_EQ(Due(), expected) << "poison";
  EXPECT_EQ(Due(), "");
}

TEST_P(Outbox, CallsNobodyWhoDidNotAsk) {
  InsertFor({});
  Succeed(Claim());
  InsertFor({"http://a/done", "", ""});
  const Job job = Claim();
  ASSERT_TRUE(*store_->Fail(job.id, job.run, {ErrorCode::kIo, "x", "internal-error"}, ++time_));
  EXPECT_EQ(Due(), "");
}

TEST_P(Outbox, AClaimEndsWithItsLease) {
  InsertFor(kWhom);
  Succeed(Claim());
  EXPECT_EQ(Due(milliseconds(1000)), "success http://a/done 1");
  const DueCallback first = *last_;
  EXPECT_EQ(Due(), "");
  std::this_thread::sleep_for(milliseconds(1100));
  time_ += 1100;
  EXPECT_EQ(Due(), "success http://a/done 2");
  EXPECT_FALSE(*store_->EndCallback(first, CallbackEnd::kDelivered)) << "another one has it";
  EXPECT_FALSE(*store_->RetryCallback(first, milliseconds(0), ++time_));
  EXPECT_GE(last_->age, milliseconds(1000));
  ASSERT_TRUE(*store_->EndCallback(*last_, CallbackEnd::kGivenUp));
  time_ += 100'000;
  EXPECT_EQ(Due(), "");
}

TEST_P(Outbox, IsTriedAgainAfterItsDelay) {
  InsertFor(kWhom);
  Succeed(Claim());
  EXPECT_EQ(Due(), "success http://a/done 1");
  ASSERT_TRUE(*store_->RetryCallback(*last_, milliseconds(1000), ++time_));
  EXPECT_EQ(Due(), "");
  std::this_thread::sleep_for(milliseconds(1100));
  time_ += 1100;
  EXPECT_EQ(Due(), "success http://a/done 2");
  Reopen();
  EXPECT_EQ(Due(), "") << "a lease outlives the process";
  ASSERT_TRUE(*store_->RetryCallback(*last_, milliseconds(0), time_));
  ++time_;
  EXPECT_EQ(Due(), "success http://a/done 3");
}

TEST_P(Outbox, IsNoMoreWhereTheJobIsRemoved) {
  InsertFor(kWhom);
  const Job job = Claim();
  Succeed(job);
  ASSERT_TRUE(store_->Dismiss(job.id, ++time_));
  EXPECT_EQ(Due(), "");
  InsertFor(kWhom);
  Succeed(Claim());
  ASSERT_EQ(*store_->RemoveExpired({1, 0, 0}, time_ + 10'000), 1);
  EXPECT_EQ(Due(), "");
}

TEST_P(Outbox, GivesEachCallToOneThread) {
  constexpr int kJobs = 20;
  for (int i = 0; i < kJobs; ++i) {
    InsertFor(kWhom);
    Succeed(Claim());
  }
  ++time_;
  std::atomic<int> claimed{0};
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&] {
      while (claimed < kJobs) {
        auto callback = store_->ClaimCallback(std::chrono::seconds(30), time_);
        if (!callback || !*callback) return;
        ++claimed;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  while (!Due().empty()) ++claimed;
  EXPECT_EQ(claimed, kJobs);
}

TEST_P(JobStoreConformance, KnowsAFetchedInputByItsLink) {
  NewJob job{"dem.tif", {}, std::string(64, 'a'), 5, "key"};
  job.source = std::string(64, '1');
  EXPECT_FALSE(store_->FindEarlier(job, ++time_)->has_value());
  const auto first = store_->Insert(job, {}, ++time_);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->source, job.source);
  job.input_sha256 = std::string(64, 'b');
  EXPECT_EQ((*store_->FindEarlier(job, ++time_))->id, first->id) << "whatever is there by now";
  EXPECT_EQ(store_->Insert(job, {}, ++time_)->id, first->id);
  for (const NewJob& other : {[&] {
                                NewJob one = job;
                                one.source = std::string(64, '2');
                                return one;
                              }(),
                              [&] {
                                NewJob one = job;
                                one.source = "";
                                return one;
                              }(),
                              [&] {
                                NewJob one = job;
                                one.parameters = {{"levels", "2"}};
                                return one;
                              }(),
                              [&] {
                                NewJob one = job;
                                one.subscriber = kWhom;
                                return one;
                              }()}) {
    EXPECT_EQ(store_->FindEarlier(other, ++time_).error().kind, "idempotency-key-reused");
    EXPECT_EQ(store_->Insert(other, {}, ++time_).error().kind, "idempotency-key-reused");
  }
  job.idempotency_key = "other";
  EXPECT_FALSE(store_->FindEarlier(job, ++time_)->has_value());
}

TEST_P(JobStoreConformance, KnowsASubscriberByItsCallsThatWereMade) {
  NewJob job{"dem.tif", {}, std::string(64, 'a'), 5, "key"};
  job.subscriber = kWhom;
  const auto first = store_->Insert(job, {}, ++time_);
  Succeed(Claim());
  const auto callback = store_->ClaimCallback(std::chrono::seconds(30), ++time_);
  ASSERT_TRUE(*store_->EndCallback(**callback, CallbackEnd::kDelivered));
  EXPECT_EQ(store_->Insert(job, {}, ++time_)->id, first->id);
  job.subscriber.failed_uri = "http://b/";
  EXPECT_EQ(store_->Insert(job, {}, ++time_).error().kind, "idempotency-key-reused");
}

}  // namespace
}  // namespace farhorizon

// The job store on a real PostgreSQL server, and what several processes do to one another there.
// The program skips where Debian's postgresql-15 is not installed.
#include "service/jobs/postgres_job_store.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstdio>
#include <mutex>
#include <set>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "service/jobs/postgres.h"
#include "service/jobs/storage_file.h"
#include "tests/service/jobs/job_store_conformance.h"
#include "tests/service/jobs/upload_conformance.h"
#include "tests/support/postgres_server.h"

// libpqxx 6.4 does not free the result of a statement whose connection is lost.
// NOLINTNEXTLINE(readability-identifier-naming,bugprone-reserved-identifier): the sanitizer's name
extern "C" const char* __lsan_default_suppressions();
// NOLINTNEXTLINE(readability-identifier-naming,bugprone-reserved-identifier)
extern "C" const char* __lsan_default_suppressions() {
  return "leak:pqxx::connection_base::exec_params\n";
}

namespace farhorizon {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using std::chrono::steady_clock;

constexpr const char* kAda = "ada0";
constexpr const char* kBob = "b0b0";

PostgresServer& Server() {
  static PostgresServer server;
  return server;
}

class PostgresStorage : public JobStorage {
 public:
  PostgresStorage() : url_(Server().NewDatabase()) {}
  Result<std::unique_ptr<JobStore>> Open() override { return OpenAs(kAda); }
  void Start(const std::string& client) override {
    PostgresDatabase database(url_, {}, {});
    Statement(database,
              "UPDATE jobs SET state = 'running', run = 1, attempt = 1, holder = ?, "
              "lease_until = clock_timestamp() + interval '1 hour' WHERE client = ?")
        .Bind(kAda)
        .Bind(client)
        .Run();
  }

  Result<std::unique_ptr<JobStore>> OpenAs(const std::string& holder,
                                           milliseconds lease = seconds(30)) {
    return OpenPostgresJobStore({url_, holder, lease, 4});
  }
  [[nodiscard]] const std::string& url() const { return url_; }

 private:
  std::string url_;
};

std::unique_ptr<JobStorage> MakePostgresStorage(const std::filesystem::path& /*folder*/) {
  return std::make_unique<PostgresStorage>();
}

INSTANTIATE_TEST_SUITE_P(Postgres, JobStoreConformance, testing::Values(MakePostgresStorage));
INSTANTIATE_TEST_SUITE_P(Postgres, Choice, testing::Values(MakePostgresStorage));
INSTANTIATE_TEST_SUITE_P(Postgres, Expiry, testing::Values(MakePostgresStorage));
INSTANTIATE_TEST_SUITE_P(Postgres, UploadConformance, testing::Values(MakePostgresStorage));
INSTANTIATE_TEST_SUITE_P(Postgres, Outbox, testing::Values(MakePostgresStorage));

// Two processes on one store.
class SharedStore : public testing::Test {
 protected:
  void SetUp() override {
    ada_ = *storage_.OpenAs(kAda);
    bob_ = *storage_.OpenAs(kBob);
  }
  std::string Insert() {
    const auto job = ada_->Insert({"dem.tif", {}, std::string(64, 'a'), 5, {}}, {}, ++time_);
    EXPECT_TRUE(job);
    return job->id;
  }
  // By the row, not by waiting: a busy machine loses leases that are short.
  void LetLeasesEnd(milliseconds after = milliseconds(-1)) {
    PostgresDatabase database(storage_.url(), {}, {});
    Statement(database,
              "UPDATE jobs SET lease_until = clock_timestamp() + ? * interval '1 millisecond'")
        .Bind(std::int64_t{after.count()})
        .Run();
  }

  PostgresStorage storage_;
  std::unique_ptr<JobStore> ada_;
  std::unique_ptr<JobStore> bob_;
  std::int64_t time_ = 1'700'000'000'000;
};

TEST_F(SharedStore, ALostLeaseMakesTheJobAnothersAndTheLateWriterStoresNothing) {
  const std::string id = Insert();
  const Job late = **ada_->ClaimNext(++time_, {});
  EXPECT_EQ(*bob_->RecoverLost(++time_), 0) << "the lease is good";
  EXPECT_FALSE(*bob_->ClaimNext(++time_, {}));
  LetLeasesEnd();
  EXPECT_EQ(*bob_->RecoverLost(++time_), 1);
  const Job job = **bob_->ClaimNext(++time_, {});
  EXPECT_EQ(job.id, id);
  EXPECT_EQ(job.run, late.run + 1);
  EXPECT_EQ(*ada_->Hold({{id, late.run}}), std::vector<std::string>{id});
  EXPECT_FALSE(*ada_->ReportProgress(id, late.run, 90, "encode", ++time_));
  EXPECT_FALSE(
      *ada_->Publish(id, late.run, {{"late", "a/b", 1, std::string(64, 'b')}}, {}, ++time_));
  EXPECT_FALSE(*ada_->Fail(id, late.run, {ErrorCode::kIo, "x"}, ++time_));
  EXPECT_FALSE(*ada_->Requeue(id, late.run, RequeueReason::kServiceStopped, ++time_));
  EXPECT_TRUE(*bob_->Publish(id, job.run, {}, {}, ++time_));
  EXPECT_TRUE(ada_->Artifacts(id)->empty());
}

TEST_F(SharedStore, ACallIsOfOneProcessForItsLease) {
  NewJob asked{"dem.tif", {}, std::string(64, 'a'), 5, {}};
  asked.subscriber = {"http://a/", "", ""};
  ASSERT_TRUE(ada_->Insert(asked, {}, ++time_));
  const Job job = **ada_->ClaimNext(++time_, {});
  ASSERT_TRUE(*ada_->Publish(job.id, job.run, {}, {}, ++time_));
  const auto frozen = **ada_->ClaimCallback(seconds(30), ++time_);
  EXPECT_FALSE(bob_->ClaimCallback(seconds(30), time_ + 100'000)->has_value())
      << "by the server's clock";
  PostgresDatabase(storage_.url(), {}, {}).Execute("UPDATE callbacks SET due_ms = due_ms - 31000");
  const auto again = **bob_->ClaimCallback(seconds(30), ++time_);
  EXPECT_EQ(again.job_id, frozen.job_id);
  EXPECT_EQ(again.attempt, 2);
  EXPECT_FALSE(*ada_->EndCallback(frozen, CallbackEnd::kGivenUp)) << "it is bob's now";
  EXPECT_TRUE(*bob_->EndCallback(again, CallbackEnd::kDelivered));
}

TEST_F(SharedStore, ALeaseThatIsRenewedLasts) {
  const std::string id = Insert();
  const Job job = **ada_->ClaimNext(++time_, {});
  LetLeasesEnd(milliseconds(100));
  EXPECT_TRUE(ada_->Hold({{id, job.run}})->empty());
  std::this_thread::sleep_for(milliseconds(200));
  EXPECT_EQ(*bob_->RecoverLost(++time_), 0);
}

TEST_F(SharedStore, AResultOfALeaseThatNobodyElseTookIsGood) {
  const std::string id = Insert();
  const Job job = **ada_->ClaimNext(++time_, {});
  LetLeasesEnd();
  EXPECT_TRUE(*ada_->Publish(id, job.run, {}, {}, ++time_));
  EXPECT_EQ(*bob_->RecoverLost(++time_), 0);
}

TEST_F(SharedStore, AStartTakesUpTheJobsOfItsOwnFolderAlone) {
  Insert();
  Insert();
  const Job of_ada = **ada_->ClaimNext(++time_, {});
  const Job of_bob = **bob_->ClaimNext(++time_, {});
  EXPECT_NE(of_ada.id, of_bob.id);
  ada_ = *storage_.OpenAs(kAda);
  EXPECT_EQ(*ada_->RecoverRunning(PreviousEnd::kKilled, ++time_), 1);
  EXPECT_EQ(bob_->Find(of_ada.id)->state, JobState::kAccepted);
  EXPECT_TRUE(*bob_->Publish(of_bob.id, of_bob.run, {}, {}, ++time_));
}

TEST_F(SharedStore, AJobThatLosesTenLeasesFails) {
  const auto brief = *storage_.OpenAs(kBob, milliseconds(1));
  const std::string id = Insert();
  for (int lost = 1; lost <= 10; ++lost) {
    ASSERT_TRUE(*brief->ClaimNext(++time_, {})) << lost;
    std::this_thread::sleep_for(milliseconds(5));
    EXPECT_EQ(*ada_->RecoverLost(++time_), lost < 10 ? 1 : 0);
  }
  const Job job = *ada_->Find(id);
  EXPECT_EQ(job.state, JobState::kFailed);
  EXPECT_EQ(job.failure->kind, "poison-job");
}

TEST_F(SharedStore, HandsOutEachJobOnceToManyProcesses) {
  constexpr std::size_t kJobs = 80;
  for (std::size_t i = 0; i < kJobs; ++i) Insert();
  std::mutex mutex;
  std::multiset<std::string> claimed;
  std::vector<std::thread> threads;
  for (JobStore* store : {ada_.get(), bob_.get(), ada_.get(), bob_.get()}) {
    threads.emplace_back([&, store] {
      for (;;) {
        auto job = store->ClaimNext(time_, {});
        ASSERT_TRUE(job);
        if (!*job) return;
        const std::lock_guard lock(mutex);
        claimed.insert((*job)->id);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(claimed.size(), kJobs);
  EXPECT_EQ(std::set<std::string>(claimed.begin(), claimed.end()).size(), kJobs);
}

TEST_F(SharedStore, ClientsHaveTheirTurnsOverAllProcesses) {
  for (const char* client : {"a", "a", "a", "b", "b", "b"}) {
    ASSERT_TRUE(ada_->Insert({"x", {}, std::string(64, 'a'), 5, {}, {}, client}, {}, ++time_));
  }
  std::string turns;
  for (int i = 0; i < 6; ++i) {
    JobStore& store = i % 2 == 0 ? *ada_ : *bob_;
    const Job job = **store.ClaimNext(++time_, {});
    turns += job.client;
    ASSERT_TRUE(*store.Publish(job.id, job.run, {}, {}, ++time_));
  }
  EXPECT_EQ(turns, "ababab");
}

TEST_F(SharedStore, OneKeyMakesOneJobWhoeverTakesIt) {
  std::mutex mutex;
  std::set<std::string> ids;
  std::vector<std::thread> threads;
  for (int i = 0; i < 8; ++i) {
    threads.emplace_back([&, i] {
      JobStore& store = i % 2 == 0 ? *ada_ : *bob_;
      const auto job = store.Insert({"x", {}, std::string(64, 'a'), 5, "key"}, {}, time_);
      ASSERT_TRUE(job);
      const std::lock_guard lock(mutex);
      ids.insert(job->id);
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(ids.size(), 1U);
}

TEST_F(SharedStore, TellsOthersOfJobsThatWaitAndOfRunsThatEnded) {
  std::mutex mutex;
  std::condition_variable changed;
  int waits = 0;
  int ended = 0;
  bob_->Listen([&](StoreNews news) {
    const std::lock_guard lock(mutex);
    ++(news == StoreNews::kJobWaits ? waits : ended);
    changed.notify_all();
  });
  const auto wait = [&](const auto& condition) {
    std::unique_lock lock(mutex);
    return changed.wait_for(lock, seconds(10), condition);
  };
  ASSERT_TRUE(wait([&] { return waits == 1 && ended == 1; })) << "once, when it begins";
  const std::string id = Insert();
  EXPECT_TRUE(wait([&] { return waits == 2; }));
  const Job job = **bob_->ClaimNext(++time_, {});
  ASSERT_TRUE(ada_->Dismiss(id, ++time_));
  EXPECT_TRUE(wait([&] { return ended == 2; }));
  EXPECT_EQ(*bob_->Hold({{id, job.run}}), std::vector<std::string>{id});
  bob_->Listen(nullptr);
}

TEST_F(SharedStore, NobodyRemovesObjectsWhileAnotherProcessStoresSome) {
  auto pin = ada_->PinObjects();
  ASSERT_TRUE(pin && *pin);
  std::thread([&] {
    const auto second = bob_->PinObjects();
    EXPECT_TRUE(second && *second) << "many may store";
  }).join();
  auto halt = bob_->HaltPins(false);
  ASSERT_TRUE(halt);
  EXPECT_EQ(*halt, nullptr);
  halt = bob_->HaltPins(true);
  ASSERT_TRUE(halt);
  EXPECT_EQ(*halt, nullptr) << "it has waited for a while";
  pin->reset();
  halt = bob_->HaltPins(false);
  ASSERT_TRUE(halt && *halt);
  std::atomic<bool> pinned{false};
  std::thread storing([&] {
    const auto later = ada_->PinObjects();
    EXPECT_TRUE(later && *later);
    pinned = true;
  });
  std::this_thread::sleep_for(milliseconds(200));
  EXPECT_FALSE(pinned);
  halt->reset();
  storing.join();
}

TEST_F(SharedStore, AThreadWhosePinIsLostStoresNothing) {
  auto pin = ada_->PinObjects();
  ASSERT_TRUE(pin && *pin);
  Server().Crash();
  Server().Start();
  const auto job = ada_->Insert({"x", {}, std::string(64, 'a'), 5, {}}, {}, ++time_);
  ASSERT_FALSE(job) << "another process may have removed its object";
  EXPECT_TRUE(IsMachineFault(job.error()));
  pin->reset();
  EXPECT_TRUE(ada_->List({})->jobs.empty());
  EXPECT_TRUE(ada_->Insert({"x", {}, std::string(64, 'a'), 5, {}}, {}, ++time_));
}

TEST_F(SharedStore, WhatWasAcknowledgedIsThereAfterACrashOfTheServer) {
  const std::string id = Insert();
  Server().Crash();
  const auto down = ada_->Find(id);
  ASSERT_FALSE(down);
  EXPECT_EQ(down.error().code, ErrorCode::kResourceExhausted) << "which clients are told as 503";
  EXPECT_TRUE(down.error().kind.empty());
  EXPECT_TRUE(IsMachineFault(down.error()));
  EXPECT_FALSE(ada_->Ping());
  Server().Start();
  const auto deadline = steady_clock::now() + seconds(20);
  auto found = ada_->Find(id);
  while (!found && steady_clock::now() < deadline) {
    std::this_thread::sleep_for(milliseconds(50));
    found = ada_->Find(id);
  }
  ASSERT_TRUE(found);
  EXPECT_EQ(found->state, JobState::kAccepted);
  EXPECT_TRUE(bob_->Find(id)) << "connections of before are made anew unseen";
}

TEST_F(SharedStore, AServerThatIsFrozenKeepsNobodyWaitingForEver) {
  const std::string id = Insert();
  ASSERT_TRUE(bob_->Find(id));
  Server().Signal(SIGSTOP);
  const auto begin = steady_clock::now();
  const auto found = bob_->Find(id);
  Server().Signal(SIGCONT);
  EXPECT_FALSE(found);
  EXPECT_LT(steady_clock::now() - begin, seconds(20));
  std::this_thread::sleep_for(seconds(1));
  EXPECT_TRUE(ada_->Find(id));
}

TEST_F(SharedStore, KeepsTextThatNoColumnCould) {
  Insert();
  const Job job = **ada_->ClaimNext(++time_, {});
  const std::string text = std::string("a\0b", 3) + "\xff" + "é";
  ASSERT_TRUE(*ada_->ReportProgress(job.id, job.run, 1, text, ++time_));
  EXPECT_EQ(ada_->Find(job.id)->message, "ab\uFFFDé");
}

TEST(PostgresSchema, ManyThatStartAtOnceMakeTheTablesOnce) {
  PostgresStorage storage;
  std::atomic<int> opened{0};
  std::vector<std::thread> threads;
  for (int i = 0; i < 8; ++i) {
    threads.emplace_back([&] { opened += storage.Open() ? 1 : 0; });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(opened, 8);
}

TEST(PostgresSchema, TablesOfANewerVersionAreRefused) {
  PostgresStorage storage;
  ASSERT_TRUE(storage.Open());
  PostgresDatabase(storage.url(), {}, {}).Execute("UPDATE schema_version SET version = 1000");
  const auto opened = storage.Open();
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().kind, "job-store-unusable");
  EXPECT_THAT(opened.error().message, testing::HasSubstr("newer farhorizon"));
}

TEST(PostgresSchema, AnotherEncodingIsRefused) {
  PostgresStorage storage;
  PostgresDatabase(storage.url(), {}, {})
      .Execute("CREATE DATABASE latin ENCODING 'LATIN1' TEMPLATE template0");
  std::string url = storage.url();
  url.replace(url.find("///") + 3, url.find('?') - url.find("///") - 3, "latin");
  const auto opened = OpenPostgresJobStore({url, kAda, seconds(30), 1});
  ASSERT_FALSE(opened);
  EXPECT_THAT(opened.error().message, testing::HasSubstr("UTF8"));
}

TEST(PostgresSchema, AServerThatIsNotThereIsNamedWithTheRemedy) {
  const auto opened = OpenPostgresJobStore({"postgresql:///x?host=/nowhere", kAda, seconds(30), 1});
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().kind, "job-store-unusable");
  EXPECT_THAT(opened.error().message, testing::HasSubstr("store.jobs"));
}

}  // namespace
}  // namespace farhorizon

int main(int argc, char** argv) {
  testing::InitGoogleMock(&argc, argv);
  if (!farhorizon::PostgresServer::IsInstalled()) {
    std::puts("skipped: no postgresql-15; get it with config/install-dependencies test");
    return 77;
  }
  return RUN_ALL_TESTS();
}

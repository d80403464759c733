#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "service/jobs/job_store.h"
#include "tests/support/temp_dir.h"

namespace farhorizon {

/// What a job store keeps its jobs in. A new implementation of JobStore makes one, and instantiates
/// the suites JobStoreConformance, Choice, Expiry and Outbox with it.
class JobStorage {
 public:
  JobStorage() = default;
  virtual ~JobStorage() = default;
  JobStorage(const JobStorage&) = delete;
  JobStorage& operator=(const JobStorage&) = delete;

  /// The store, as a process finds it that starts after another one.
  virtual Result<std::unique_ptr<JobStore>> Open() = 0;
  /// Lets the accepted jobs of a client run, without a claim.
  virtual void Start(const std::string& client) = 0;
};

/// A storage without jobs; the folder is its own.
using MakeJobStorage =
    std::function<std::unique_ptr<JobStorage>(const std::filesystem::path& folder)>;

class JobStoreConformance : public testing::TestWithParam<MakeJobStorage> {
 protected:
  void SetUp() override {
    storage_ = GetParam()(folder_.path());
    Reopen();
  }
  void Reopen() {
    store_.reset();
    auto opened = storage_->Open();
    ASSERT_TRUE(opened) << opened.error().message;
    store_ = *std::move(opened);
  }
  Job Insert(const std::string& content = "a", std::optional<std::string> key = {}) {
    NewJob job{"dem.tif", {{"levels", "2"}}, std::string(64, content[0]), 5, std::move(key)};
    auto inserted = store_->Insert(job, {}, ++time_);
    EXPECT_TRUE(inserted);
    return *inserted;
  }
  Job InsertOf(const std::string& client) {
    auto inserted =
        store_->Insert({"dem.tif", {}, std::string(64, 'a'), 5, {}, {}, client}, {}, ++time_);
    EXPECT_TRUE(inserted);
    return *inserted;
  }
  void Succeed(const Job& job) { EXPECT_TRUE(*store_->Publish(job.id, job.run, {}, {}, ++time_)); }
  Job Claim() {
    auto claimed = store_->ClaimNext(++time_, {});
    EXPECT_TRUE(claimed && *claimed);
    return **claimed;
  }
  JobState StateOf(const Job& job) { return store_->Find(job.id)->state; }

  TempDir folder_;
  std::unique_ptr<JobStorage> storage_;
  std::unique_ptr<JobStore> store_;
  std::int64_t time_ = 1'700'000'000'000;
};

class Choice : public JobStoreConformance {
 protected:
  std::string With(const JobTerms& terms, const std::string& client = "") {
    auto job =
        store_->Insert({"a", {}, std::string(64, 'a'), 5, {}, {}, client, terms, {}}, {}, ++time_);
    EXPECT_TRUE(job);
    return job->id;
  }
  std::string Costing(std::int64_t memory_bytes, const std::string& client = "") {
    auto job = store_->Insert(
        {"a", {}, std::string(64, 'a'), 5, {}, {}, client, {}, {memory_bytes, 1}}, {}, ++time_);
    EXPECT_TRUE(job);
    return job->id;
  }
  // The id of the job that starts where so much memory is free; "" for none.
  std::string Next(std::int64_t free_bytes = 100) {
    auto job = store_->ClaimNext(++time_, {free_bytes, 100});
    EXPECT_TRUE(job);
    return *job ? (*job)->id : "";
  }
  void End(const std::string& id) { EXPECT_TRUE(*store_->Publish(id, 1, {}, {}, ++time_)); }
};

class Expiry : public JobStoreConformance {
 protected:
  std::string Done(std::int64_t bytes) {
    Insert();
    const Job job = Claim();
    EXPECT_TRUE(*store_->Publish(job.id, job.run, {{"a", "x/y", bytes, std::string(64, 'b')}}, {},
                                 ++time_));
    return job.id;
  }
  std::vector<std::string> Left() {
    std::vector<std::string> ids;
    const auto page = store_->List({{}, {}, 100});
    for (const Job& job : page->jobs) ids.insert(ids.begin(), job.id);
    return ids;
  }
  std::int64_t Remove(const Retention& retention) {
    const auto removed = store_->RemoveExpired(retention, time_);
    EXPECT_TRUE(removed);
    return *removed;
  }
};

class Outbox : public JobStoreConformance {
 protected:
  Job InsertFor(const Subscriber& whom, const JobTerms& terms = {}) {
    NewJob job{"a", {}, std::string(64, 'a'), 5, {}};
    job.terms = terms;
    job.subscriber = whom;
    auto inserted = store_->Insert(job, {}, ++time_);
    EXPECT_TRUE(inserted) << inserted.error().message;
    return *inserted;
  }
  // The next call, "EVENT URL ATTEMPT", which is claimed; "" for none.
  std::string Due(std::chrono::milliseconds lease = std::chrono::seconds(30)) {
    auto callback = store_->ClaimCallback(lease, ++time_);
    EXPECT_TRUE(callback) << callback.error().message;
    if (!*callback) return "";
    last_ = **callback;
    return std::string(kCallbackEventNames.at(static_cast<std::size_t>(last_->event))) + " " +
           last_->url + " " + std::to_string(last_->attempt);
  }

  std::optional<DueCallback> last_;
};

}  // namespace farhorizon

#include "service/jobs/object_collector.h"

#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "service/jobs/local_object_store.h"
#include "service/jobs/sqlite_job_store.h"
#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

class ObjectCollectorTest : public testing::Test {
 protected:
  void SetUp() override {
    auto jobs = OpenSqliteJobStore(folder_ / "jobs.sqlite");
    auto objects = OpenLocalObjectStore(folder_ / "objects");
    ASSERT_TRUE(jobs && objects);
    jobs_ = *std::move(jobs);
    objects_ = *std::move(objects);
  }
  std::string Put(const std::string& bytes) {
    SpillFile(folder_ / "file", bytes);
    auto stored = objects_->PutFile(folder_ / "file");
    EXPECT_TRUE(stored);
    return stored->sha256;
  }

  TempDir folder_;
  std::unique_ptr<JobStore> jobs_;
  std::unique_ptr<ObjectStore> objects_;
};

TEST_F(ObjectCollectorTest, KeepsWhatIsReferencedAndRemovesWhatWasNeverAcknowledged) {
  const std::string referenced = Put("referenced");
  Put("never acknowledged");
  ASSERT_TRUE(jobs_->Insert({"a", {}, referenced, 5, {}}, {}, 1));
  const auto sorted = ObjectCollector(*jobs_, *objects_).SortOut();
  ASSERT_TRUE(sorted);
  EXPECT_EQ(sorted->strays, 0);
  EXPECT_EQ(*objects_->List(ObjectList::kAll), std::vector<std::string>{referenced});
  EXPECT_THAT(*objects_->List(ObjectList::kIncoming), testing::IsEmpty());
}

TEST_F(ObjectCollectorTest, SetsAsideWhatNoRowKnowsAndTakesItBackWhenOneDoes) {
  const std::string stray = Put("stray");
  objects_->Keep({stray});
  ObjectCollector collector(*jobs_, *objects_);
  EXPECT_EQ(collector.SortOut()->strays, 1);
  EXPECT_EQ(*objects_->List(ObjectList::kStray), std::vector<std::string>{stray});
  EXPECT_FALSE(objects_->Open(stray));
  EXPECT_EQ(SlurpFile(folder_ / "objects" / "stray" / stray), "stray");
  ASSERT_TRUE(jobs_->Insert({"a", {}, stray, 5, {}}, {}, 1));
  EXPECT_EQ(collector.SortOut()->taken_back, 1);
  EXPECT_TRUE(objects_->Open(stray));
}

TEST_F(ObjectCollectorTest, RemovesWhatRemovedJobsHaveLeft) {
  const std::string input = Put("input");
  const std::string shared = Put("shared");
  objects_->Keep({input, shared});
  ASSERT_TRUE(jobs_->Insert({"a", {}, input, 5, {}}, {}, 1));
  const auto job = jobs_->ClaimNext(2, {});
  ASSERT_TRUE(*jobs_->Publish((*job)->id, 1, {{"x", "a/b", 6, shared}}, {}, 3));
  ASSERT_TRUE(jobs_->Insert({"a", {}, shared, 6, {}}, {}, 4));
  // As of a process that ended between the row and the files.
  ASSERT_TRUE(jobs_->Dismiss((*job)->id, 5));
  EXPECT_THAT(*jobs_->Garbage(), testing::UnorderedElementsAre(input, shared));
  EXPECT_EQ(ObjectCollector(*jobs_, *objects_).SortOut()->strays, 0);
  EXPECT_EQ(*objects_->List(ObjectList::kAll), std::vector<std::string>{shared});
  EXPECT_THAT(*jobs_->Garbage(), testing::IsEmpty());
}

TEST_F(ObjectCollectorTest, LeavesToLaterWhatItWouldHaveToWaitFor) {
  const std::string input = Put("input");
  objects_->Keep({input});
  const auto job = jobs_->Insert({"a", {}, input, 5, {}}, {}, 1);
  ASSERT_TRUE(jobs_->ClaimNext(2, {}));
  ASSERT_TRUE(*jobs_->Publish(job->id, 1, {}, {}, 3));
  ASSERT_TRUE(jobs_->Dismiss(job->id, 4));
  const std::string incoming = Put("incoming");
  ObjectCollector collector(*jobs_, *objects_);
  {
    const auto pin = collector.Pin();  // results are being stored
    std::thread([&] { EXPECT_TRUE(collector.RemoveUnlessPinned({input, incoming})); }).join();
    EXPECT_EQ(objects_->List(ObjectList::kAll)->size(), 2U);
  }
  EXPECT_TRUE(collector.RemoveUnacknowledged());
  EXPECT_TRUE(collector.RemoveGarbage());
  EXPECT_THAT(*objects_->List(ObjectList::kAll), testing::IsEmpty());
  const std::string at_once = Put("at once");
  EXPECT_TRUE(collector.RemoveUnlessPinned({at_once}));
  EXPECT_THAT(*objects_->List(ObjectList::kAll), testing::IsEmpty());
}

TEST_F(ObjectCollectorTest, RemovesOnlyTheObjectsThatAreNamed) {
  const std::string named = Put("named");
  const std::string other = Put("other");
  ASSERT_TRUE(ObjectCollector(*jobs_, *objects_).RemoveUnreferenced({named}));
  EXPECT_EQ(*objects_->List(ObjectList::kAll), std::vector<std::string>{other});
}

}  // namespace
}  // namespace farhorizon

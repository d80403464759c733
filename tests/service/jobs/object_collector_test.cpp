#include "service/jobs/object_collector.h"

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

TEST_F(ObjectCollectorTest, KeepsReferencedObjectsOnly) {
  const std::string referenced = Put("referenced");
  Put("unreferenced");
  ASSERT_TRUE(jobs_->Insert({NewJobId(1), "a", {}, referenced, 5, {}}, 1));
  ASSERT_TRUE(ObjectCollector(*jobs_, *objects_).RemoveAllUnreferenced());
  EXPECT_EQ(*objects_->List(), std::vector<std::string>{referenced});
}

TEST_F(ObjectCollectorTest, RemovesOnlyTheObjectsThatAreNamed) {
  const std::string named = Put("named");
  const std::string other = Put("other");
  ASSERT_TRUE(ObjectCollector(*jobs_, *objects_).RemoveUnreferenced({named}));
  EXPECT_EQ(*objects_->List(), std::vector<std::string>{other});
}

}  // namespace
}  // namespace farhorizon

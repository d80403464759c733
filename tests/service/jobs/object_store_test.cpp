// The properties of every ObjectStore, on the local one.
#include "service/jobs/object_store.h"

#include <memory>

#include <gtest/gtest.h>

#include "service/jobs/local_object_store.h"
#include "tests/support/temp_dir.h"

namespace farhorizon {
namespace {

class ObjectStoreTest : public testing::Test {
 protected:
  void SetUp() override {
    auto opened = OpenLocalObjectStore(folder_ / "objects");
    ASSERT_TRUE(opened);
    store_ = *std::move(opened);
  }
  std::string Put(const std::string& bytes) {
    SpillFile(folder_ / "file", bytes);
    auto stored = store_->PutFile(folder_ / "file");
    EXPECT_TRUE(stored);
    return stored->sha256;
  }

  TempDir folder_;
  std::unique_ptr<ObjectStore> store_;
};

TEST_F(ObjectStoreTest, GivesBackWhatItWasGiven) {
  const std::string name = Put("hello");
  EXPECT_EQ(name, "2cf24dba5fb0a30e26e83b2ac5b9e29e1b161e5c1fa7425e73043362938b9824");
  EXPECT_EQ(store_->Open(name)->bytes, 5);
  ASSERT_TRUE(store_->CopyTo(name, folder_ / "copy"));
  EXPECT_EQ(SlurpFile(folder_ / "copy"), "hello");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "file"));
}

TEST_F(ObjectStoreTest, StoresTheSameBytesOnce) {
  EXPECT_EQ(Put("a"), Put("a"));
  EXPECT_EQ(store_->List(ObjectList::kAll)->size(), 1U);
}

TEST_F(ObjectStoreTest, AnObjectIsIncomingUntilARowNamesIt) {
  const std::string name = Put("a");
  EXPECT_EQ(*store_->List(ObjectList::kIncoming), std::vector<std::string>{name});
  store_->Keep({name});
  EXPECT_TRUE(store_->List(ObjectList::kIncoming)->empty());
  EXPECT_EQ(*store_->List(ObjectList::kAll), std::vector<std::string>{name});
  Put("a");
  ASSERT_TRUE(store_->Remove(name));
  EXPECT_TRUE(store_->List(ObjectList::kIncoming)->empty());
  EXPECT_TRUE(std::filesystem::is_empty(folder_ / "objects" / "temp"));
}

TEST_F(ObjectStoreTest, HealsADamagedObjectWhenItsBytesComeAgain) {
  const std::string name = Put("hello");
  const auto path = folder_ / "objects" / name.substr(0, 2) / name;
  std::filesystem::permissions(path, std::filesystem::perms::owner_all);
  SpillFile(path, "hellp");
  ASSERT_EQ(Put("hello"), name);
  EXPECT_EQ(SlurpFile(path), "hello");
}

TEST_F(ObjectStoreTest, ForgetsWhatIsRemoved) {
  const std::string name = Put("a");
  EXPECT_TRUE(store_->Remove(name));
  EXPECT_TRUE(store_->Remove(name));
  EXPECT_EQ(store_->Open(name).error().code, ErrorCode::kNotFound);
}

TEST_F(ObjectStoreTest, FollowsNoLink) {
  SpillFile(folder_ / "secret", "s");
  std::filesystem::create_symlink(folder_ / "secret", folder_ / "link");
  EXPECT_FALSE(store_->PutFile(folder_ / "link"));
  EXPECT_FALSE(store_->Open("../secret"));
}

TEST_F(ObjectStoreTest, SeesADamagedObjectBeforeAWorkerDoes) {
  const std::string name = Put("hello");
  const auto path = folder_ / "objects" / name.substr(0, 2) / name;
  std::filesystem::permissions(path, std::filesystem::perms::owner_all);
  SpillFile(path, "hellp");
  EXPECT_EQ(store_->CopyTo(name, folder_ / "copy").error().kind, "input-corrupt");
}

}  // namespace
}  // namespace farhorizon

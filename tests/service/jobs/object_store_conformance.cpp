// The properties of every ObjectStore.
#include "tests/service/jobs/object_store_conformance.h"

#include <vector>

#include "core/io/posix_file.h"
#include "core/io/sha256.h"

namespace farhorizon {
namespace {

using Names = std::vector<std::string>;

TEST_P(ObjectStoreConformance, GivesBackWhatItWasGiven) {
  const std::string name = Put("hello");
  EXPECT_EQ(name, "2cf24dba5fb0a30e26e83b2ac5b9e29e1b161e5c1fa7425e73043362938b9824");
  EXPECT_EQ(store_->Open(name)->bytes, 5);
  ASSERT_TRUE(store_->CopyTo(name, folder_ / "copy"));
  EXPECT_EQ(SlurpFile(folder_ / "copy"), "hello");
  EXPECT_EQ(Read(name), "hello");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "file"));
}

TEST_P(ObjectStoreConformance, TakesObjectsOfEverySize) {
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{3} << 20U}) {
    std::string bytes(size, 'x');
    for (std::size_t i = 0; i < size; i += 997) bytes[i] = static_cast<char>(i);
    const std::string name = Put(bytes);
    EXPECT_EQ(name, Sha256Hex(bytes));
    ASSERT_TRUE(store_->CopyTo(name, folder_ / name));
    EXPECT_TRUE(SlurpFile(folder_ / name) == bytes) << size;
    EXPECT_TRUE(Read(name) == bytes) << size;
  }
}

TEST_P(ObjectStoreConformance, StoresTheSameBytesOnce) {
  EXPECT_EQ(Put("a"), Put("a"));
  EXPECT_EQ(store_->List(ObjectList::kAll)->size(), 1U);
}

TEST_P(ObjectStoreConformance, AnObjectIsIncomingUntilARowNamesIt) {
  const std::string name = Put("a");
  EXPECT_EQ(*store_->List(ObjectList::kIncoming), Names{name});
  EXPECT_EQ(*OpenStore()->List(ObjectList::kIncoming), Names{name});
  store_->Keep({name});
  EXPECT_TRUE(store_->List(ObjectList::kIncoming)->empty());
  EXPECT_EQ(*store_->List(ObjectList::kAll), Names{name});
  Put("a");
  ASSERT_TRUE(store_->Remove(name));
  EXPECT_TRUE(store_->List(ObjectList::kIncoming)->empty());
}

TEST_P(ObjectStoreConformance, ForgetsWhatIsRemoved) {
  const std::string name = Put("a");
  EXPECT_TRUE(store_->Remove(name));
  EXPECT_TRUE(store_->Remove(name));
  EXPECT_EQ(store_->Open(name).error().code, ErrorCode::kNotFound);
  EXPECT_EQ(store_->CopyTo(name, folder_ / "copy").error().code, ErrorCode::kNotFound);
}

TEST_P(ObjectStoreConformance, AReaderReadsOnWhenTheObjectIsRemoved) {
  const std::string name = Put("hello");
  const Result<OpenObject> object = store_->Open(name);
  ASSERT_TRUE(object && store_->Remove(name));
  std::string bytes(9, ' ');
  EXPECT_EQ(ReadSome(object->fd.get(), bytes), 5);
}

TEST_P(ObjectStoreConformance, FollowsNoLink) {
  SpillFile(folder_ / "secret", "s");
  std::filesystem::create_symlink(folder_ / "secret", folder_ / "link");
  EXPECT_FALSE(store_->PutFile(folder_ / "link"));
  EXPECT_EQ(store_->Open("../secret").error().code, ErrorCode::kNotFound);
}

TEST_P(ObjectStoreConformance, SeesADamagedObjectAndHealsItWhenItsBytesComeAgain) {
  const std::string name = Put("hello");
  store_->Distrust(name);
  storage_->Damage(name, "hellp");
  EXPECT_EQ(store_->CopyTo(name, folder_ / "copy").error().kind, "input-corrupt");
  ASSERT_EQ(Put("hello"), name);
  EXPECT_EQ(Read(name), "hello");
}

TEST_P(ObjectStoreConformance, AStrayIsNoObjectUntilItIsTakenBack) {
  const std::string name = Put("hello");
  store_->Keep({name});
  ASSERT_TRUE(store_->SetAside(name));
  EXPECT_TRUE(store_->List(ObjectList::kAll)->empty());
  EXPECT_EQ(*store_->List(ObjectList::kStray), Names{name});
  EXPECT_EQ(store_->Open(name).error().code, ErrorCode::kNotFound);
  ASSERT_TRUE(store_->TakeBack(name));
  EXPECT_TRUE(store_->List(ObjectList::kStray)->empty());
  EXPECT_EQ(Read(name), "hello");
}

TEST_P(ObjectStoreConformance, OneOfTwoClaimsTheLabel) {
  EXPECT_EQ(store_->Label().error().code, ErrorCode::kNotFound);
  EXPECT_EQ(*store_->ClaimLabel("ada 0\n"), "ada 0\n");
  EXPECT_EQ(*OpenStore()->ClaimLabel("bob 0\n"), "ada 0\n");
  ASSERT_TRUE(store_->SetLabel("ada 1\n"));
  EXPECT_EQ(*OpenStore()->Label(), "ada 1\n");
  EXPECT_TRUE(store_->List(ObjectList::kAll)->empty());
}

TEST_P(ObjectStoreConformance, AnObjectOutOfReachIsAFaultOfTheStorageAndNotMissing) {
  const std::string name = Put("hello");
  store_->Distrust(name);
  storage_->TakeAway();
  EXPECT_EQ(store_->Open(name).error().kind, "storage");
  EXPECT_EQ(store_->CopyTo(name, folder_ / "copy").error().kind, "storage");
  SpillFile(folder_ / "file", "new");
  EXPECT_EQ(store_->PutFile(folder_ / "file").error().kind, "storage");
  EXPECT_EQ(SlurpFile(folder_ / "file"), "new");
  EXPECT_FALSE(store_->CheckWrites());
  storage_->BringBack();
  EXPECT_EQ(Read(name), "hello");
}

}  // namespace
}  // namespace farhorizon

#include "service/jobs/local_object_store.h"

#include "tests/service/jobs/object_store_conformance.h"

namespace farhorizon {
namespace {

class LocalStorage : public ObjectStorage {
 public:
  explicit LocalStorage(const std::filesystem::path& folder) : root_(folder / "objects") {}
  Result<std::unique_ptr<ObjectStore>> Open() override {
    return OpenLocalObjectStore(root_, Sharing::kManyProcesses);
  }
  void Damage(const std::string& sha256, const std::string& bytes) override {
    const auto path = root_ / sha256.substr(0, 2) / sha256;
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
    SpillFile(path, bytes);
  }
  void TakeAway() override { std::filesystem::rename(root_, root_.string() + "-away"); }
  void BringBack() override { std::filesystem::rename(root_.string() + "-away", root_); }

 private:
  std::filesystem::path root_;
};

std::unique_ptr<ObjectStorage> MakeLocalStorage(const std::filesystem::path& folder) {
  return std::make_unique<LocalStorage>(folder);
}

INSTANTIATE_TEST_SUITE_P(Local, ObjectStoreConformance, testing::Values(MakeLocalStorage));

TEST(LocalObjectStore, LeavesNothingInItsTemporaryFolder) {
  const TempDir folder;
  auto store = OpenLocalObjectStore(folder / "objects", Sharing::kManyProcesses);
  ASSERT_TRUE(store);
  SpillFile(folder / "file", "hello");
  ASSERT_TRUE((*store)->PutFile(folder / "file"));
  ASSERT_TRUE((*store)->ClaimLabel("a"));
  ASSERT_TRUE((*store)->CheckWrites());
  EXPECT_TRUE(std::filesystem::is_empty(folder / "objects" / "temp"));
}

}  // namespace
}  // namespace farhorizon

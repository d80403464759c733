#pragma once

#include <functional>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "service/jobs/object_store.h"
#include "tests/support/temp_dir.h"

namespace farhorizon {

/// What an object store keeps its objects in. A new implementation of ObjectStore makes one, and
/// instantiates ObjectStoreConformance with it.
class ObjectStorage {
 public:
  ObjectStorage() = default;
  virtual ~ObjectStorage() = default;
  ObjectStorage(const ObjectStorage&) = delete;
  ObjectStorage& operator=(const ObjectStorage&) = delete;

  /// The store, as a process finds it that shares it with others.
  virtual Result<std::unique_ptr<ObjectStore>> Open() = 0;
  /// Writes to the stored object, past the store.
  virtual void Damage(const std::string& sha256, const std::string& bytes) = 0;
  /// Takes the whole storage out of reach, and back.
  virtual void TakeAway() = 0;
  virtual void BringBack() = 0;
};

/// A storage without objects; the folder is its own.
using MakeObjectStorage =
    std::function<std::unique_ptr<ObjectStorage>(const std::filesystem::path& folder)>;

class ObjectStoreConformance : public testing::TestWithParam<MakeObjectStorage> {
 protected:
  void SetUp() override {
    storage_ = GetParam()(folder_.path());
    store_ = OpenStore();
  }
  std::unique_ptr<ObjectStore> OpenStore() {
    auto opened = storage_->Open();
    EXPECT_TRUE(opened) << opened.error().message;
    return *std::move(opened);
  }
  std::string Put(const std::string& bytes) {
    SpillFile(folder_ / "file", bytes);
    auto stored = store_->PutFile(folder_ / "file");
    EXPECT_TRUE(stored) << stored.error().message;
    return stored ? stored->sha256 : "";
  }
  /// What another process reads, that has no copy of it; "" for nothing.
  std::string Read(const std::string& name) {
    const std::unique_ptr<ObjectStore> other = OpenStore();
    const std::filesystem::path target = folder_ / ("read" + std::to_string(reads_++));
    return other->CopyTo(name, target) ? SlurpFile(target) : "";
  }

  TempDir folder_;
  std::unique_ptr<ObjectStorage> storage_;
  std::unique_ptr<ObjectStore> store_;
  int reads_ = 0;
};

}  // namespace farhorizon

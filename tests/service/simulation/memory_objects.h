#pragma once

#include <set>
#include <string>
#include <vector>

#include "service/jobs/object_store.h"

namespace farhorizon {

/// The names of objects, in memory: what a collector of garbage works on, without a disk.
class MemoryObjects : public ObjectStore {
 public:
  /// Stores an object as incoming.
  void Put(const std::string& name) {
    all_.insert(name);
    incoming_.insert(name);
  }
  [[nodiscard]] bool Has(const std::string& name) const { return all_.contains(name); }

  Result<StoredObject> PutFile(const std::filesystem::path& file) override {
    return Error{ErrorCode::kIo, "there are no files here: " + file.string()};
  }
  void Keep(const std::vector<std::string>& names) override {
    for (const std::string& name : names) incoming_.erase(name);
  }
  Result<OpenObject> Open(const std::string& sha256) override {
    if (Has(sha256)) return OpenObject{};
    return Error{ErrorCode::kNotFound, "no object " + sha256};
  }
  Status CopyTo(const std::string& sha256, const std::filesystem::path& /*target*/) override {
    return Error{ErrorCode::kNotFound, "no object " + sha256};
  }
  Status Remove(const std::string& sha256) override {
    all_.erase(sha256);
    incoming_.erase(sha256);
    return Ok{};
  }
  Status SetAside(const std::string& sha256) override {
    stray_.insert(sha256);
    return Remove(sha256);
  }
  Status TakeBack(const std::string& sha256) override {
    stray_.erase(sha256);
    all_.insert(sha256);
    return Ok{};
  }
  Result<std::vector<std::string>> List(ObjectList which) override {
    const std::set<std::string>& names = which == ObjectList::kAll        ? all_
                                         : which == ObjectList::kIncoming ? incoming_
                                                                          : stray_;
    return std::vector<std::string>(names.begin(), names.end());
  }

  Result<std::string> Label() override {
    if (!label_.empty()) return label_;
    return Error{ErrorCode::kNotFound, "no label"};
  }
  Status SetLabel(const std::string& label) override {
    label_ = label;
    return Ok{};
  }
  Result<std::string> ClaimLabel(const std::string& label) override {
    if (label_.empty()) label_ = label;
    return label_;
  }
  Status CheckWrites() override { return Ok{}; }
  Result<DiskRoom> Room() override { return DiskRoom{1 << 30, 1 << 20}; }

 private:
  std::string label_;
  std::set<std::string> all_;
  std::set<std::string> incoming_;
  std::set<std::string> stray_;
};

}  // namespace farhorizon

#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "service/auth/api_key.h"

namespace farhorizon {

/// The keys of a running service. Each call looks whether the file has changed, which costs a
/// stat(), and then reads it: a key that is added or revoked is so from the next request on. A file
/// that can no longer be read leaves the keys as they were, and the log says so.
/// Threads: safe.
class KeyRing {
 public:
  /// Errors: those of ReadKeys, but for a file that is not there.
  static Result<std::shared_ptr<KeyRing>> Open(const std::filesystem::path& file);

  /// Whether the file is there, or was while this object lives.
  bool HadFile();
  /// The number of keys that are neither revoked nor expired.
  std::int64_t CountLive(std::int64_t now_ms);

  /// The key with this text. In time that does not depend on the text. Errors: kNotFound
  ///   "invalid-key" for every other text; the message tells more only to who has the key.
  Result<ApiKey> Match(std::string_view text, std::int64_t now_ms);
  /// The live key with this id. Errors: the same.
  Result<ApiKey> Find(const std::string& id, std::int64_t now_ms);

 private:
  // What changes with the file.
  using Stamp = std::array<std::int64_t, 7>;

  explicit KeyRing(std::filesystem::path file) : file_(std::move(file)) {}
  /// Requires: the mutex is held.
  Status Refresh();
  void RefreshOrKeep();

  const std::filesystem::path file_;
  std::mutex mutex_;
  Stamp stamp_{};  // of the file that was read
  Stamp seen_{};   // of the last one that could not be
  bool had_file_ = false;
  std::map<std::string, ApiKey> keys_;
};

}  // namespace farhorizon

#include "service/auth/key_ring.h"

#include <sys/stat.h>
#include <utility>
#include <vector>

#include "service/auth/key_file.h"
#include "service/log.h"

namespace farhorizon {

namespace {

constexpr std::array<std::uint8_t, Digest::kBytes> kNone{};

Error InvalidKey(const std::string& why) { return {ErrorCode::kNotFound, why, "invalid-key"}; }

Result<ApiKey> LiveOne(const ApiKey& key, std::int64_t now_ms) {
  if (key.revoked_ms) return InvalidKey("the key was revoked; ask the operator for another");
  if (!key.IsLive(now_ms)) return InvalidKey("the key has expired; ask the operator for another");
  return key;
}

}  // namespace

Result<std::shared_ptr<KeyRing>> KeyRing::Open(const std::filesystem::path& file) {
  std::shared_ptr<KeyRing> ring(new KeyRing(file));
  Status read = ring->Refresh();
  if (!read) return std::move(read.error());
  return ring;
}

Status KeyRing::Refresh() {
  struct stat info {};
  Stamp stamp{};
  if (::stat(file_.c_str(), &info) == 0) {
    stamp = {static_cast<std::int64_t>(info.st_dev),
             static_cast<std::int64_t>(info.st_ino),
             info.st_size,
             info.st_mtim.tv_sec,
             info.st_mtim.tv_nsec,
             info.st_ctim.tv_sec,
             info.st_ctim.tv_nsec};
    had_file_ = true;
  }
  if (stamp == stamp_) return Ok{};
  Result<std::vector<ApiKey>> keys = ReadKeys(file_);
  if (!keys && keys.error().code != ErrorCode::kNotFound) {
    seen_ = stamp;
    return std::move(keys.error());
  }
  stamp_ = stamp;
  keys_.clear();
  if (!keys) return Ok{};
  for (ApiKey& key : *keys) {
    const std::string id = key.id;
    keys_.insert_or_assign(id, std::move(key));
  }
  return Ok{};
}

void KeyRing::RefreshOrKeep() {
  const Stamp seen = seen_;
  const Status read = Refresh();
  if (read || seen == seen_) return;  // the same file is not complained of twice
  Log(LogLevel::kError, "the keys cannot be read anew; those that were read before stay",
      {{"error", read.error().message}});
}

bool KeyRing::HadFile() {
  const std::lock_guard lock(mutex_);
  RefreshOrKeep();
  return had_file_;
}

std::int64_t KeyRing::CountLive(std::int64_t now_ms) {
  const std::lock_guard lock(mutex_);
  RefreshOrKeep();
  std::int64_t count = 0;
  for (const auto& [id, key] : keys_) count += key.IsLive(now_ms) ? 1 : 0;
  return count;
}

Result<ApiKey> KeyRing::Match(std::string_view text, std::int64_t now_ms) {
  // An id is no secret: that it is looked up in a map tells nothing. What is compared in constant
  // time are hashes, and for an id that nobody has one is compared, too.
  const std::optional<std::string> id = IdOfKey(text);
  if (!id) return InvalidKey("this is no key of this service");
  Sha256 sum;
  sum.Add(text);
  const Digest given = sum.Finish();
  const std::lock_guard lock(mutex_);
  RefreshOrKeep();
  const auto found = keys_.find(*id);
  const bool same = SameDigest(given, found == keys_.end() ? Digest(kNone) : found->second.digest);
  if (!same || found == keys_.end()) return InvalidKey("this is no key of this service");
  return LiveOne(found->second, now_ms);
}

Result<ApiKey> KeyRing::Find(const std::string& id, std::int64_t now_ms) {
  const std::lock_guard lock(mutex_);
  RefreshOrKeep();
  const auto found = keys_.find(id);
  if (found == keys_.end()) return InvalidKey("this is no key of this service");
  return LiveOne(found->second, now_ms);
}

}  // namespace farhorizon

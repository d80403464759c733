#include "service/auth/key_file.h"

#include <cerrno>
#include <cstdint>
#include <fcntl.h>
#include <optional>
#include <string>
#include <sys/file.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/io/file.h"
#include "core/io/posix_file.h"
#include "core/io/unique_fd.h"
#include "service/strict_json.h"

namespace farhorizon {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int kVersion = 1;
// A key takes 250 bytes: some 60,000 of them.
constexpr std::uintmax_t kLargestFile = std::uintmax_t{16} << 20U;

Error Unusable(const fs::path& file, const std::string& why) {
  return {ErrorCode::kIo, "keys " + file.string() + ": " + why, "data-directory"};
}

Error Unusable(const fs::path& file, const std::string& doing, int number) {
  Error error = ErrorFromErrno(doing, number);
  error.message = "keys " + file.string() + ": " + error.message;
  error.kind = error.code == ErrorCode::kResourceExhausted ? ErrorKind("no-space")
                                                           : ErrorKind("data-directory");
  return error;
}

std::optional<std::int64_t> Time(const json& entry, const char* name) {
  const auto found = entry.find(name);
  if (found == entry.end() || !found->is_number_integer()) return std::nullopt;
  return found->get<std::int64_t>();
}

std::string Text(const json& entry, const char* name) {
  const auto found = entry.find(name);
  return found != entry.end() && found->is_string() ? found->get<std::string>() : std::string();
}

std::optional<ApiKey> KeyOf(const json& entry) {
  if (!entry.is_object()) return std::nullopt;
  const std::optional<Digest> digest = Digest::FromHex(Text(entry, "sha256"));
  const Result<Scopes> scopes = ReadScopes(Text(entry, "scopes"));
  const std::optional<std::int64_t> created = Time(entry, "created_ms");
  if (!digest || !scopes || !created) return std::nullopt;
  ApiKey key{
      Text(entry, "id"), Text(entry, "owner"),      Text(entry, "name"),      *scopes, *digest,
      *created,          Time(entry, "expires_ms"), Time(entry, "revoked_ms")};
  // A time that cannot be read must not make a key of a dead one.
  const bool times = key.expires_ms.has_value() == entry.contains("expires_ms") &&
                     key.revoked_ms.has_value() == entry.contains("revoked_ms");
  if (!times || !IsKeyId(key.id) || !IsKeyId(key.owner) || !CheckKeyName(key.name)) {
    return std::nullopt;
  }
  return key;
}

json EntryOf(const ApiKey& key) {
  std::string scopes;
  for (const std::string& name : NamesOf(key.scopes)) scopes += (scopes.empty() ? "" : ",") + name;
  json entry = {{"id", key.id},     {"owner", key.owner},         {"name", key.name},
                {"scopes", scopes}, {"sha256", key.digest.Hex()}, {"created_ms", key.created_ms}};
  if (key.expires_ms) entry["expires_ms"] = *key.expires_ms;
  if (key.revoked_ms) entry["revoked_ms"] = *key.revoked_ms;
  return entry;
}

// Makes a file that is its owner's alone, and gives it to the owner of the folder.
Result<UniqueFd> OpenOwn(const fs::path& file, const fs::path& path, int flags) {
  UniqueFd opened(::open(path.c_str(), flags | O_CLOEXEC | O_NOFOLLOW, 0600));
  if (!opened) return Unusable(file, "make " + path.filename().string(), errno);
  struct stat folder {};
  if (::stat(path.parent_path().c_str(), &folder) != 0) return Unusable(file, "stat", errno);
  const bool foreign = ::geteuid() == 0 && folder.st_uid != 0;
  if (foreign && ::fchown(opened.get(), folder.st_uid, folder.st_gid) != 0) {
    return Unusable(file, "give it to the owner of its folder", errno);
  }
  return opened;
}

Status Replace(const fs::path& file, const std::string& text) {
  const fs::path fresh = file.string() + ".new";
  ::unlink(fresh.c_str());
  const Result<UniqueFd> opened = OpenOwn(file, fresh, O_WRONLY | O_CREAT | O_EXCL);
  if (!opened) return opened.error();
  if (!WriteAll(opened->get(), text) || ::fsync(opened->get()) != 0 ||
      ::rename(fresh.c_str(), file.c_str()) != 0 || !SyncDirectory(file.parent_path())) {
    const int number = errno;
    ::unlink(fresh.c_str());
    return Unusable(file, "write", number);
  }
  return Ok{};
}

}  // namespace

Result<std::vector<ApiKey>> ReadKeys(const fs::path& file) {
  const Result<std::string> text = ReadFile(file, kLargestFile);
  if (!text) {
    if (text.error().code == ErrorCode::kNotFound) return text.error();
    return Unusable(file, text.error().message);
  }
  const Result<json> document = ParseStrictJson(*text);
  if (!document || !document->is_object() || !document->contains("keys") ||
      !document->at("keys").is_array()) {
    return Unusable(file, "it is no file of keys; put it back from a backup, or make new keys");
  }
  if (document->value("version", 0) != kVersion) {
    return Unusable(file, "it comes from another version of farhorizon; use that one");
  }
  std::vector<ApiKey> keys;
  for (const json& entry : document->at("keys")) {
    std::optional<ApiKey> key = KeyOf(entry);
    if (!key) {
      return Unusable(file, "its entry " + std::to_string(keys.size() + 1) +
                                " is damaged; put the file back from a backup");
    }
    keys.push_back(*std::move(key));
  }
  return keys;
}

Status ChangeKeys(const fs::path& given,
                  const std::function<Status(std::vector<ApiKey>& keys)>& change) {
  const fs::path file = AbsolutePath(given);
  std::error_code failure;
  const bool made = fs::create_directories(file.parent_path(), failure);
  if (failure) return Unusable(file, "its folder cannot be made: " + failure.message());
  if (made) ::chmod(file.parent_path().c_str(), 0700);
  const Result<UniqueFd> lock = OpenOwn(file, file.string() + ".lock", O_RDWR | O_CREAT);
  if (!lock) return lock.error();
  if (::flock(lock->get(), LOCK_EX) != 0) return Unusable(file, "lock", errno);
  Result<std::vector<ApiKey>> keys = ReadKeys(file);
  if (!keys && keys.error().code == ErrorCode::kNotFound) keys = std::vector<ApiKey>();
  if (!keys) return std::move(keys.error());
  Status changed = change(*keys);
  if (!changed) return changed;
  json document = {{"version", kVersion}, {"keys", json::array()}};
  for (const ApiKey& key : *keys) document["keys"].push_back(EntryOf(key));
  return Replace(file, document.dump(2, ' ', false, json::error_handler_t::replace) + "\n");
}

}  // namespace farhorizon

#include "service/jobs/s3_object_store.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <limits>
#include <mutex>
#include <optional>
#include <string>
#include <unistd.h>
#include <utility>
#include <vector>

#include "service/jobs/object_cache.h"
#include "service/jobs/storage_file.h"
#include "service/s3/s3_bucket.h"

namespace farhorizon {

namespace {

namespace fs = std::filesystem;

constexpr const char* kLabel = "identity";
// A request costs: a probe of the bucket is asked for as seldom as who waits for it may bear.
constexpr std::chrono::seconds kFresh{10};

std::string ObjectKey(const std::string& sha256) { return "objects/" + sha256; }
std::string IncomingKey(const std::string& sha256) { return "incoming/" + sha256; }
std::string StrayKey(const std::string& sha256) { return "stray/" + sha256; }

std::vector<std::string> KeysOf(const std::vector<std::string>& names,
                                std::string (*key)(const std::string& sha256)) {
  std::vector<std::string> keys;
  std::transform(names.begin(), names.end(), std::back_inserter(keys), key);
  return keys;
}

class S3ObjectStore : public ObjectStore {
 public:
  S3ObjectStore(const S3StoreOptions& options, std::unique_ptr<ObjectCache> cache)
      : credentials_(options.credentials, AwsEnvironment()),
        bucket_(options.location, credentials_),
        cache_(std::move(cache)) {}

  Result<StoredObject> PutFile(const fs::path& file) override;
  void Keep(const std::vector<std::string>& names) override;
  Result<OpenObject> Open(const std::string& sha256) override;
  Status CopyTo(const std::string& sha256, const fs::path& target) override;
  Status Remove(const std::string& sha256) override { return RemoveAll({sha256}); }
  Status RemoveAll(const std::vector<std::string>& names) override;
  Status SetAside(const std::string& sha256) override;
  Status TakeBack(const std::string& sha256) override;
  Result<std::vector<std::string>> List(ObjectList which) override;
  void Distrust(const std::string& sha256) override { cache_->Drop(sha256); }
  Result<std::string> Label() override { return bucket_.GetText(kLabel); }
  Status SetLabel(const std::string& label) override { return bucket_.PutText(kLabel, label); }
  Result<std::string> ClaimLabel(const std::string& label) override;
  Status CheckWrites() override;
  Result<DiskRoom> Room() override;

 private:
  Status Move(const std::string& from, const std::string& to);

  S3Credentials credentials_;
  S3Bucket bucket_;
  std::unique_ptr<ObjectCache> cache_;
  std::mutex mutex_;
  std::optional<Status> last_check_;
  std::chrono::steady_clock::time_point checked_;
};

Result<StoredObject> S3ObjectStore::PutFile(const fs::path& file) {
  Result<UniqueFd> source = OpenForReading(file);
  if (!source) return std::move(source.error());
  // A private copy, as in LocalObjectStore: who made `file` may still write to it.
  Result<SpoolFile> copy = cache_->NewFile();
  if (!copy) return std::move(copy.error());
  Result<StoredObject> object = CopyAndHash(source->get(), copy->fd());
  if (!object) return object;
  Result<UniqueFd> bytes = OpenForReading(copy->path());
  if (!bytes) return std::move(bytes.error());
  Status stored = bucket_.PutText(IncomingKey(object->sha256), "");
  if (stored) stored = bucket_.PutFile(ObjectKey(object->sha256), bytes->get(), object->bytes);
  if (!stored) return std::move(stored.error());
  cache_->Keep(*copy, *object);
  ::unlink(file.c_str());
  return object;
}

void S3ObjectStore::Keep(const std::vector<std::string>& names) {
  // A name that stays is taken off by the next RemoveUnacknowledged of any process.
  (void)bucket_.DeleteAll(KeysOf(names, IncomingKey));
}

Result<OpenObject> S3ObjectStore::Open(const std::string& sha256) {
  if (!IsSha256(sha256)) return Error{ErrorCode::kNotFound, "no such object"};
  return cache_->Get(sha256, [&](int fd) { return bucket_.GetFile(ObjectKey(sha256), fd); });
}

Status S3ObjectStore::CopyTo(const std::string& sha256, const fs::path& target) {
  // Twice, for a copy on this machine may have been damaged since it was fetched.
  for (int tries = 1;; ++tries) {
    Result<OpenObject> object = Open(sha256);
    if (!object) return std::move(object.error());
    Status copied = CopyObject(*object, sha256, target);
    if (copied) return copied;
    ::unlink(target.c_str());
    if (copied.error().kind != "input-corrupt") return copied;
    Distrust(sha256);
    if (tries == 2) return copied;
  }
}

// While objects are removed nobody stores any: so few requests as there can be.
Status S3ObjectStore::RemoveAll(const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    Check(IsSha256(name), "an object's name is a SHA-256");
    cache_->Drop(name);
  }
  // The other names last: what a kill leaves is then still known to be incoming.
  Status removed = bucket_.DeleteAll(KeysOf(names, ObjectKey));
  return removed ? bucket_.DeleteAll(KeysOf(names, IncomingKey)) : removed;
}

Status S3ObjectStore::SetAside(const std::string& sha256) {
  cache_->Drop(sha256);
  return Move(ObjectKey(sha256), StrayKey(sha256));
}

Status S3ObjectStore::TakeBack(const std::string& sha256) {
  return Move(StrayKey(sha256), ObjectKey(sha256));
}

Status S3ObjectStore::Move(const std::string& from, const std::string& to) {
  Status copied = bucket_.Copy(from, to);
  return copied ? bucket_.Delete(from) : copied;
}

Result<std::vector<std::string>> S3ObjectStore::List(ObjectList which) {
  const std::string key = which == ObjectList::kAll        ? ObjectKey("")
                          : which == ObjectList::kIncoming ? IncomingKey("")
                                                           : StrayKey("");
  Result<std::vector<std::string>> names = bucket_.List(key);
  if (names) std::erase_if(*names, [](const std::string& name) { return !IsSha256(name); });
  return names;
}

Result<std::string> S3ObjectStore::ClaimLabel(const std::string& label) {
  // A server that knows no conditional PUT would replace what is there.
  Result<std::string> there = Label();
  if (there || there.error().code != ErrorCode::kNotFound) return there;
  Result<bool> claimed = bucket_.PutNewText(kLabel, label);
  if (!claimed) return std::move(claimed.error());
  return Label();
}

Status S3ObjectStore::CheckWrites() {
  const std::lock_guard lock(mutex_);
  const auto now = std::chrono::steady_clock::now();
  if (last_check_ && now - checked_ < (*last_check_ ? kFresh : kFresh / 10)) return *last_check_;
  last_check_ = bucket_.TryPutText("probe", "");
  checked_ = std::chrono::steady_clock::now();
  return *last_check_;
}

Result<DiskRoom> S3ObjectStore::Room() {
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
  return DiskRoom{kMost, kMost};
}

}  // namespace

Result<std::unique_ptr<ObjectStore>> OpenS3ObjectStore(const S3StoreOptions& options) {
  Result<std::unique_ptr<ObjectCache>> cache = ObjectCache::Make(
      options.cache, options.cache_bytes, options.least_free_bytes, options.patience);
  if (!cache) return std::move(cache.error());
  auto store = std::make_unique<S3ObjectStore>(options, *std::move(cache));
  Result<std::string> label = store->Label();
  if (!label && label.error().code != ErrorCode::kNotFound) return std::move(label.error());
  return std::unique_ptr<ObjectStore>(std::move(store));
}

}  // namespace farhorizon

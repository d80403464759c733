#include "service/jobs/object_cache.h"

#include <algorithm>
#include <sys/stat.h>
#include <system_error>
#include <thread>
#include <unistd.h>
#include <utility>
#include <vector>

#include "core/io/sha256.h"
#include "service/jobs/storage_file.h"
#include "service/random.h"

namespace farhorizon {

namespace {

namespace fs = std::filesystem;

constexpr int kLeastFetches = 3;
constexpr std::chrono::milliseconds kFirstPause{100};
constexpr std::chrono::seconds kLongestPause{2};

Error NotThere() { return {ErrorCode::kNotFound, "no such copy"}; }

// The SHA-256 of an open file, which is at its start again afterwards.
Result<std::string> SumOf(int fd) {
  Sha256 sum;
  Status read = ForEachPiece(fd, "read a copy of an object", [&](std::string_view piece) -> Status {
    sum.Add(piece);
    return Ok{};
  });
  if (!read) return std::move(read.error());
  if (::lseek(fd, 0, SEEK_SET) != 0) return StorageError("read a copy of an object");
  return sum.Finish().Hex();
}

// When a file was opened last, of which the next process orders them. Its time of change stays:
// by that, readers know that its bytes are those that they have compared.
void NoteUse(int fd) {
  const timespec times[2] = {{0, UTIME_NOW}, {0, UTIME_OMIT}};
  ::futimens(fd, times);
}

}  // namespace

Result<std::unique_ptr<ObjectCache>> ObjectCache::Make(const fs::path& folder,
                                                       std::int64_t most_bytes,
                                                       std::int64_t least_free,
                                                       std::chrono::milliseconds patience) {
  std::unique_ptr<ObjectCache> cache(new ObjectCache(folder, most_bytes, least_free, patience));
  std::error_code failure;
  fs::remove_all(cache->temp_, failure);
  if (!failure) fs::create_directories(cache->temp_, failure);
  if (failure) {
    return Error{ErrorCode::kIo, "make the folder " + folder.string() + ": " + failure.message(),
                 "storage"};
  }
  Status read = cache->ReadFolder();
  if (!read) return std::move(read.error());
  return cache;
}

Status ObjectCache::ReadFolder() {
  struct Found {
    std::string name;
    std::int64_t bytes;
    timespec used;
  };
  std::vector<Found> found;
  std::error_code failure;
  for (fs::directory_iterator it(folder_, failure), end; !failure && it != end;
       it.increment(failure)) {
    struct stat info {};
    const std::string name = it->path().filename().string();
    if (!IsSha256(name) || ::lstat(it->path().c_str(), &info) != 0) continue;
    found.push_back({name, info.st_size, info.st_atim});
  }
  if (failure) {
    return Error{ErrorCode::kIo, "list copies of objects: " + failure.message(), "storage"};
  }
  std::sort(found.begin(), found.end(), [](const Found& a, const Found& b) {
    return std::pair(a.used.tv_sec, a.used.tv_nsec) < std::pair(b.used.tv_sec, b.used.tv_nsec);
  });
  const std::lock_guard lock(mutex_);
  for (const Found& file : found) Add(file.name, file.bytes, false);
  return Ok{};
}

Result<OpenObject> ObjectCache::Get(const std::string& sha256, const Fetch& fetch) {
  std::unique_lock lock(mutex_);
  for (;;) {
    Result<OpenObject> there = Take(sha256);
    if (there) return there;
    const auto other = flights_.find(sha256);
    if (other == flights_.end()) break;
    const std::shared_ptr<Flight> flight = other->second;
    landed_.wait(lock, [&] { return flight->over; });
    if (!flight->status) return flight->status.error();
  }
  flights_[sha256] = std::make_shared<Flight>();
  lock.unlock();
  try {
    Result<OpenObject> brought = TakeChecked(sha256);
    if (!brought) brought = Bring(sha256, fetch);
    Land(sha256, brought ? Status(Ok{}) : Status(brought.error()));
    return brought;
  } catch (...) {
    Land(sha256, Error{ErrorCode::kIo, "an object was not fetched", "storage"});
    throw;
  }
}

void ObjectCache::Land(const std::string& sha256, const Status& status) {
  const std::lock_guard lock(mutex_);
  const auto flight = flights_.extract(sha256);
  flight.mapped()->over = true;
  flight.mapped()->status = status;
  landed_.notify_all();
}

Result<OpenObject> ObjectCache::Take(const std::string& sha256) {
  const auto found = entries_.find(sha256);
  if (found == entries_.end() || !found->second.sound) return NotThere();
  Result<OpenObject> object = OpenObjectFile(folder_ / sha256);
  if (!object || object->bytes != found->second.bytes) {
    Forget(sha256);
    return NotThere();
  }
  by_use_.splice(by_use_.begin(), by_use_, found->second.place);
  NoteUse(object->fd.get());
  return object;
}

Result<OpenObject> ObjectCache::TakeChecked(const std::string& sha256) {
  {
    const std::lock_guard lock(mutex_);
    if (!entries_.contains(sha256)) return NotThere();
  }
  Result<OpenObject> object = OpenObjectFile(folder_ / sha256);
  const Result<std::string> sum = object ? SumOf(object->fd.get()) : NotThere();
  const std::lock_guard lock(mutex_);
  if (!sum || *sum != sha256) {
    Forget(sha256);
    return NotThere();
  }
  const auto found = entries_.find(sha256);
  if (found != entries_.end()) found->second.sound = true;
  return object;
}

Result<OpenObject> ObjectCache::Bring(const std::string& sha256, const Fetch& fetch) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begun = Clock::now();
  for (int fetches = 1;; ++fetches) {
    Result<SpoolFile> file = NewFile();
    if (!file) return std::move(file.error());
    Status fetched = fetch(file->fd());
    if (!fetched) return std::move(fetched.error());
    Result<OpenObject> object = OpenObjectFile(file->path());
    if (!object) return object;
    Result<std::string> sum = SumOf(object->fd.get());
    if (!sum) return std::move(sum.error());
    if (*sum == sha256) {
      Keep(*file, {sha256, object->bytes});
      return object;
    }
    if (fetches >= kLeastFetches && Clock::now() - begun > patience_) {
      return Error{ErrorCode::kIo, "the stored object is damaged; send its DEM again",
                   "input-corrupt"};
    }
    std::this_thread::sleep_for(RandomDelay(kFirstPause, kLongestPause, fetches - 1));
  }
}

void ObjectCache::Keep(const SpoolFile& file, const StoredObject& object) {
  const std::lock_guard lock(mutex_);
  Forget(object.sha256);
  if (::rename(file.path().c_str(), (folder_ / object.sha256).c_str()) != 0) return;
  Add(object.sha256, object.bytes, true);
}

void ObjectCache::Drop(const std::string& sha256) {
  const std::lock_guard lock(mutex_);
  Forget(sha256);
}

void ObjectCache::Add(const std::string& sha256, std::int64_t bytes, bool sound) {
  by_use_.push_front(sha256);
  entries_[sha256] = {bytes, sound, by_use_.begin()};
  bytes_ += bytes;
  Trim();
}

void ObjectCache::Trim() {
  while (by_use_.size() > 1) {
    const Result<std::int64_t> free = FreeBytes(folder_);
    if (bytes_ <= most_bytes_ && (!free || *free >= least_free_)) return;
    Forget(std::string(by_use_.back()));
  }
}

void ObjectCache::Forget(const std::string& sha256) {
  const auto found = entries_.find(sha256);
  if (found == entries_.end()) return;
  ::unlink((folder_ / sha256).c_str());
  bytes_ -= found->second.bytes;
  by_use_.erase(found->second.place);
  entries_.erase(found);
}

}  // namespace farhorizon

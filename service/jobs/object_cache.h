#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "core/base/result.h"
#include "service/jobs/object_store.h"
#include "service/jobs/spool_file.h"

namespace farhorizon {

/// Copies of objects on this machine's disk, of a store that is elsewhere: files named by the
/// SHA-256 of their bytes, the least recently used of which leave where there are too many bytes.
/// Nothing in it is ever missed. A file has its name only when it is whole, and what an earlier
/// process has left is compared with its name before anyone reads it, so that no sync is needed.
/// Whoever has a file open reads on when it leaves.
/// Threads: safe. Of several that ask for the same object at once, one fetches it.
class ObjectCache {
 public:
  /// Writes an object's bytes to the open file.
  using Fetch = std::function<Status(int fd)>;

  /// most_bytes: of all files, but the one that was used last stays whatever its size.
  /// least_free: room on the disk that is left, too.
  /// patience: how long other bytes than the object's are taken for a fault that passes.
  /// Requires: no other process uses the folder.
  /// Errors: kIo "storage" where the folder cannot be made or read.
  static Result<std::unique_ptr<ObjectCache>> Make(const std::filesystem::path& folder,
                                                   std::int64_t most_bytes, std::int64_t least_free,
                                                   std::chrono::milliseconds patience);

  /// Opens the object, which `fetch` gets where it is not there.
  /// Errors: those of fetch; kIo "input-corrupt" where it gets other bytes, three times at least
  ///   and as long as the patience lasts.
  Result<OpenObject> Get(const std::string& sha256, const Fetch& fetch);
  /// A file that Keep may take.
  Result<SpoolFile> NewFile() { return SpoolFile::Create(temp_); }
  /// Makes a file of NewFile, which has the object's bytes, the copy of it.
  void Keep(const SpoolFile& file, const StoredObject& object);
  void Drop(const std::string& sha256);

 private:
  struct Entry {
    std::int64_t bytes = 0;
    bool sound = false;  ///< compared with its name by this process
    std::list<std::string>::iterator place;
  };
  /// A fetch that others may wait for.
  struct Flight {
    bool over = false;
    Status status = Ok{};
  };

  ObjectCache(std::filesystem::path folder, std::int64_t most_bytes, std::int64_t least_free,
              std::chrono::milliseconds patience)
      : folder_(std::move(folder)),
        temp_(folder_ / "temp"),
        most_bytes_(most_bytes),
        least_free_(least_free),
        patience_(patience) {}
  Status ReadFolder();
  /// The file, if it is there and sound; kNotFound. Requires: mutex_ is held.
  Result<OpenObject> Take(const std::string& sha256);
  /// The file of an earlier process, if it is there and turns out to be sound; kNotFound.
  Result<OpenObject> TakeChecked(const std::string& sha256);
  /// Gets the object. Requires: no other thread does, of this object.
  Result<OpenObject> Bring(const std::string& sha256, const Fetch& fetch);
  void Land(const std::string& sha256, const Status& status);
  /// Requires, all three: mutex_ is held.
  void Add(const std::string& sha256, std::int64_t bytes, bool sound);
  void Trim();
  void Forget(const std::string& sha256);

  const std::filesystem::path folder_;
  const std::filesystem::path temp_;
  const std::int64_t most_bytes_;
  const std::int64_t least_free_;
  const std::chrono::milliseconds patience_;
  std::mutex mutex_;
  std::condition_variable landed_;
  std::map<std::string, Entry> entries_;
  std::list<std::string> by_use_;  ///< the last used first
  std::map<std::string, std::shared_ptr<Flight>> flights_;
  std::int64_t bytes_ = 0;
};

}  // namespace farhorizon

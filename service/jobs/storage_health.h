#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>

#include "core/base/result.h"
#include "service/jobs/data_directory.h"
#include "service/jobs/job_store.h"
#include "service/jobs/object_store.h"

namespace farhorizon {

/// Whether the disk under the data directory, and the storage of objects, keep what is written, and
/// have room.
/// Threads: safe.
class StorageHealth {
 public:
  /// min_free_bytes: room that uploads leave. Requires: directory and stores outlive this object.
  StorageHealth(const DataDirectory& directory, JobStore& jobs, ObjectStore& objects,
                std::int64_t min_free_bytes)
      : directory_(directory), jobs_(jobs), objects_(objects), min_free_bytes_(min_free_bytes) {}

  /// Succeeds if there is room for one more job. Cost: no write.
  /// Errors: kResourceExhausted "no-space"; kIo "data-directory" where the lock went, "storage".
  Status CheckRoom() const;
  /// Succeeds if a file of the data directory, an object, and a row of the job store can be written
  /// durably, now or within the last half second; an object in a bucket, within ten seconds.
  /// Errors: those of the storage, with the reason.
  Status CheckWrites();

 private:
  [[nodiscard]] Status CheckRoomIn(const Result<DiskRoom>& room, const char* disk) const;

  const DataDirectory& directory_;
  JobStore& jobs_;
  ObjectStore& objects_;
  std::int64_t min_free_bytes_;
  std::mutex mutex_;
  std::optional<Status> last_;
  std::chrono::steady_clock::time_point at_;
};

/// A file that takes room from a disk, to be given back where the disk is full and a change that
/// frees room (a row that is removed) needs some itself.
class DiskReserve {
 public:
  explicit DiskReserve(std::filesystem::path file) : file_(std::move(file)) {}

  /// Makes the file if it is missing and the disk has room to spare.
  void Ensure();
  /// Gives its room back; false where there was none.
  bool Release();

 private:
  std::filesystem::path file_;
};

}  // namespace farhorizon

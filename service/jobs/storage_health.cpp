#include "service/jobs/storage_health.h"

#include <cerrno>
#include <fcntl.h>
#include <string>
#include <unistd.h>

#include "core/io/posix_file.h"
#include "service/jobs/storage_file.h"

namespace farhorizon {

namespace {

constexpr std::chrono::milliseconds kFresh{500};
// A job has a dozen files in its folder, and about as many objects, each with its folder, before
// the former are gone.
constexpr std::int64_t kMinFreeFiles = 64;
constexpr std::size_t kProbeBytes = 4096;
// The pages that the removal of a hundred jobs writes to the write-ahead log: some ten for each.
constexpr std::int64_t kReserveBytes = std::int64_t{4} << 20U;

}  // namespace

Status StorageHealth::CheckRoom() const {
  Status held = directory_.CheckHeld();
  if (!held) return held;
  Status room = CheckRoomIn(directory_.root, "the disk");
  if (!room || directory_.shared_objects.empty()) return room;
  return CheckRoomIn(directory_.shared_objects, "the disk of uploads and results");
}

Status StorageHealth::CheckRoomIn(const std::filesystem::path& folder, const char* disk) const {
  Result<std::int64_t> bytes = FreeBytes(folder);
  if (!bytes) return std::move(bytes.error());
  Result<std::int64_t> files = FreeFiles(folder);
  if (!files) return std::move(files.error());
  if (*bytes >= min_free_bytes_ && *files >= kMinFreeFiles) return Ok{};
  const bool few_files = *bytes >= min_free_bytes_;
  return Error{ErrorCode::kResourceExhausted,
               std::string(disk) + " has less than " +
                   (few_files ? std::to_string(kMinFreeFiles) + " files"
                              : std::to_string(min_free_bytes_) + " bytes") +
                   " left; try later, or dismiss finished jobs",
               "no-space"};
}

Status StorageHealth::CheckWrites() {
  const std::lock_guard lock(mutex_);
  const auto now = std::chrono::steady_clock::now();
  if (last_ && now - at_ < kFresh) return *last_;
  Status written = WriteAndSync(directory_.root);
  // Where each process has a name of its own for it; what is left there goes after a day.
  const std::filesystem::path& shared = directory_.shared_objects;
  if (written && !shared.empty()) written = WriteAndSync(shared / "temp");
  if (written) written = jobs_.Ping();
  last_ = written;
  at_ = std::chrono::steady_clock::now();
  return written;
}

Status StorageHealth::WriteAndSync(const std::filesystem::path& folder) const {
  const std::filesystem::path probe = folder / ("probe" + name_);
  const std::filesystem::path renamed = folder / ("probed" + name_);
  const UniqueFd file(::open(probe.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600));
  if (!file) return StorageError("make a file");
  Status written = Ok{};
  if (!WriteAll(file.get(), std::string(kProbeBytes, 'x'))) {
    written = StorageError("write");
  } else if (written = SyncFile(file.get(), "sync a file"); written) {
    if (::rename(probe.c_str(), renamed.c_str()) != 0) written = StorageError("rename a file");
  }
  ::unlink(probe.c_str());
  ::unlink(renamed.c_str());
  return written;
}

void DiskReserve::Ensure() {
  if (::access(file_.c_str(), F_OK) == 0) return;
  Result<std::int64_t> room = FreeBytes(file_.parent_path());
  if (!room || *room < 2 * kReserveBytes) return;
  const UniqueFd file(::open(file_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600));
  if (!file) return;
  if (::posix_fallocate(file.get(), 0, kReserveBytes) != 0) ::unlink(file_.c_str());
}

bool DiskReserve::Release() { return ::unlink(file_.c_str()) == 0; }

}  // namespace farhorizon

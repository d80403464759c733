#include "service/jobs/storage_health.h"

#include <fcntl.h>
#include <string>
#include <unistd.h>

#include "service/jobs/storage_file.h"

namespace farhorizon {

namespace {

constexpr std::chrono::milliseconds kFresh{500};
// A job has a dozen files in its folder, and about as many objects, each with its folder, before
// the former are gone.
constexpr std::int64_t kMinFreeFiles = 64;
// The pages that the removal of a hundred jobs writes to the write-ahead log: some ten for each.
constexpr std::int64_t kReserveBytes = std::int64_t{4} << 20U;

}  // namespace

Status StorageHealth::CheckRoom() const {
  Status held = directory_.CheckHeld();
  if (!held) return held;
  Status room = CheckRoomIn(RoomOf(directory_.root), "the disk");
  return room ? CheckRoomIn(objects_.Room(), "the disk of uploads and results") : room;
}

Status StorageHealth::CheckRoomIn(const Result<DiskRoom>& room, const char* disk) const {
  if (!room) return room.error();
  if (room->bytes >= min_free_bytes_ && room->files >= kMinFreeFiles) return Ok{};
  const bool few_files = room->bytes >= min_free_bytes_;
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
  Status written = ProbeFolder(directory_.root);
  if (written) written = objects_.CheckWrites();
  if (written) written = jobs_.Ping();
  last_ = written;
  at_ = std::chrono::steady_clock::now();
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

#include "service/jobs/storage_file.h"

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <limits>
#include <string>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include "core/io/posix_file.h"
#include "service/jobs/sync_failure.h"

namespace farhorizon {

namespace {

constexpr std::size_t kCopiedAtOnce = std::size_t{1} << 18U;
constexpr std::size_t kProbeBytes = 4096;

}  // namespace

Error StorageError(const char* doing) {
  Error error = ErrorFromErrno(doing, errno);
  error.kind = "storage";
  if (error.code == ErrorCode::kResourceExhausted) error.kind = "no-space";
  return error;
}

Result<UniqueFd> OpenForReading(const std::filesystem::path& path) {
  // O_NONBLOCK: opening a pipe that stands in the file's place must not wait for a writer.
  UniqueFd fd(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
  if (!fd && errno == ENOENT) return Error{ErrorCode::kNotFound, "no such file"};
  if (!fd) return StorageError("open a file");
  struct stat info {};
  if (::fstat(fd.get(), &info) != 0) return StorageError("look at a file");
  if (!S_ISREG(info.st_mode)) return Error{ErrorCode::kIo, "not a regular file", "storage"};
  return fd;
}

Status ForEachPiece(int fd, const char* doing,
                    const std::function<Status(std::string_view piece)>& take) {
  std::string piece(kCopiedAtOnce, '\0');
  for (;;) {
    const std::int64_t size = ReadSome(fd, piece);
    if (size < 0) return StorageError(doing);
    if (size == 0) return Ok{};
    Status taken = take(std::string_view(piece).substr(0, static_cast<std::size_t>(size)));
    if (!taken) return taken;
  }
}

Status SyncFile(int fd, const char* doing) {
  if (::fsync(fd) == 0) return Ok{};
  Error error = StorageError(doing);
  if (errno == EIO) EndAfterFailedSync(error.message);
  return error;
}

Status SyncFolder(const std::filesystem::path& folder) {
  const UniqueFd fd(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!fd) return StorageError("open a folder");
  return SyncFile(fd.get(), "sync a folder");
}

bool IsMachineFault(const Error& error) {
  // A worker's error of a full disk has no kind.
  const bool full = error.code == ErrorCode::kResourceExhausted && error.kind.empty();
  return full || error.kind == "no-space" || error.kind == "storage" || error.kind == "job-store" ||
         error.kind == "worker-not-started" || error.kind == "data-directory";
}

Result<DiskRoom> RoomOf(const std::filesystem::path& path) {
  struct statvfs info {};
  if (::statvfs(path.c_str(), &info) != 0) return StorageError("look at the disk");
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
  const auto bytes = std::min<std::uint64_t>(info.f_bavail * info.f_frsize, kMost);
  return DiskRoom{static_cast<std::int64_t>(bytes),
                  info.f_files == 0 ? kMost : static_cast<std::int64_t>(info.f_favail)};
}

Result<std::int64_t> FreeBytes(const std::filesystem::path& path) {
  Result<DiskRoom> room = RoomOf(path);
  if (!room) return std::move(room.error());
  return room->bytes;
}

Status ProbeFolder(const std::filesystem::path& folder, const std::string& name) {
  const std::filesystem::path probe = folder / ("probe" + name);
  const std::filesystem::path renamed = folder / ("probed" + name);
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

}  // namespace farhorizon

#include "service/jobs/durable_file.h"

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <limits>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <system_error>
#include <unistd.h>

namespace farhorizon {

Error FileError(const char* doing) {
  const int cause = errno;
  const bool full = cause == ENOSPC || cause == EDQUOT || cause == EFBIG;
  return {full ? ErrorCode::kResourceExhausted : ErrorCode::kIo,
          std::string(doing) + ": " + std::generic_category().message(cause),
          full ? ErrorKind("no-space") : "storage"};
}

Status WriteAll(int fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return FileError("write");
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return Done{};
}

Status SyncDirectory(const std::filesystem::path& directory) {
  const UniqueFd fd(::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!fd || ::fsync(fd.get()) != 0) return FileError("sync a folder");
  return Done{};
}

Result<UniqueFd> OpenForReading(const std::filesystem::path& path) {
  // O_NONBLOCK: a pipe put in a file's place must not hold us.
  UniqueFd fd(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
  if (!fd && errno == ENOENT) return Error{ErrorCode::kNotFound, "no such file"};
  if (!fd) return FileError("open a file");
  struct stat info {};
  if (::fstat(fd.get(), &info) != 0) return FileError("look at a file");
  if (!S_ISREG(info.st_mode)) return Error{ErrorCode::kIo, "not a regular file", "storage"};
  return fd;
}

Result<std::int64_t> FreeBytes(const std::filesystem::path& path) {
  struct statvfs info {};
  if (::statvfs(path.c_str(), &info) != 0) return FileError("look at the disk");
  const auto most = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  return static_cast<std::int64_t>(std::min<std::uint64_t>(info.f_bavail * info.f_frsize, most));
}

}  // namespace farhorizon

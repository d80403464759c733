#include "core/io/posix_file.h"

#include <cerrno>
#include <fcntl.h>
#include <system_error>
#include <unistd.h>

#include "core/io/unique_fd.h"

namespace farhorizon {

Error ErrorFromErrno(const std::string& doing, int number) {
  const bool full = number == ENOSPC || number == EDQUOT || number == EFBIG;
  return {full ? ErrorCode::kResourceExhausted : ErrorCode::kIo,
          doing + ": " + std::generic_category().message(number)};
}

bool WriteAll(int fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

std::int64_t ReadSome(int fd, std::span<char> into) {
  for (;;) {
    const ssize_t size = ::read(fd, into.data(), into.size());
    if (size >= 0 || errno != EINTR) return size;
  }
}

bool SyncDirectory(const std::filesystem::path& directory) {
  const UniqueFd fd(::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  return fd && ::fsync(fd.get()) == 0;
}

}  // namespace farhorizon

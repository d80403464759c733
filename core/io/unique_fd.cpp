#include "core/io/unique_fd.h"

#include <cerrno>
#include <unistd.h>

namespace farhorizon {

void UniqueFd::Reset(int fd) {
  const int number = errno;
  if (fd_ >= 0) ::close(fd_);
  errno = number;
  fd_ = fd;
}

bool UniqueFd::Close() { return ::close(std::exchange(fd_, -1)) == 0; }

}  // namespace farhorizon

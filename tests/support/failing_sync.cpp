// A library to be preloaded: every sync fails, as of a disk that is broken, from when the file
// exists that the variable FAILING_SYNC names.
#include <cerrno>
#include <cstdlib>
#include <sys/syscall.h>
#include <unistd.h>

namespace {

int SyncOrFail(long call, int fd) {
  const char* file = std::getenv("FAILING_SYNC");
  if (file != nullptr && ::access(file, F_OK) == 0) {
    errno = EIO;
    return -1;
  }
  return static_cast<int>(::syscall(call, fd));
}

}  // namespace

extern "C" int fsync(int fd) { return SyncOrFail(SYS_fsync, fd); }
extern "C" int fdatasync(int fd) { return SyncOrFail(SYS_fdatasync, fd); }

// A library to be preloaded: every sync fails, as of a disk that is broken, from when the file
// exists that the variable FAILING_SYNC names. It is read when the library is loaded: the program
// keeps no variable that it does not know.
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <sys/syscall.h>
#include <unistd.h>

namespace {

const char* FileNamed() {
  const char* file = std::getenv("FAILING_SYNC");
  return file == nullptr ? nullptr : ::strdup(file);
}

const char* const file = FileNamed();

int SyncOrFail(long call, int fd) {
  if (file != nullptr && ::access(file, F_OK) == 0) {
    errno = EIO;
    return -1;
  }
  return static_cast<int>(::syscall(call, fd));
}

}  // namespace

extern "C" int fsync(int fd) { return SyncOrFail(SYS_fsync, fd); }
extern "C" int fdatasync(int fd) { return SyncOrFail(SYS_fdatasync, fd); }

// A library to be preloaded: every sync fails, as of a disk that is broken, from when the file
// exists that the variable FAILING_SYNC names.
#include <cerrno>
#include <cstdlib>
#include <string>
#include <sys/syscall.h>
#include <unistd.h>

namespace {

// Read when the library is loaded: the program may empty its environment.
const char* const kVariable = std::getenv("FAILING_SYNC");
const std::string kFile = kVariable == nullptr ? "" : kVariable;

int SyncOrFail(long call, int fd) {
  if (!kFile.empty() && ::access(kFile.c_str(), F_OK) == 0) {
    errno = EIO;
    return -1;
  }
  return static_cast<int>(::syscall(call, fd));
}

}  // namespace

extern "C" int fsync(int fd) { return SyncOrFail(SYS_fsync, fd); }
extern "C" int fdatasync(int fd) { return SyncOrFail(SYS_fdatasync, fd); }

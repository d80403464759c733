#include "service/worker/spawner/process_limits.h"

#include <algorithm>
#include <array>
#include <linux/capability.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace farhorizon {

namespace {

// As many threads as a worker may have, and then some: its programs start no process.
constexpr std::int64_t kMostThreads = 2048;

// Address space that is not memory: the program, its libraries and the database of reference
// systems take 180 MiB of it, and each thread's heap reserves 128 MiB before it has a byte. This
// bounds what the limit of private memory does not count: mappings of files, shared mappings.
constexpr std::int64_t kUnbackedBytes = std::int64_t{1} << 30U;

#if defined(__SANITIZE_ADDRESS__)
constexpr bool kLimitMemory = false;  // AddressSanitizer reserves terabytes
#else
constexpr bool kLimitMemory = true;
#endif

// A lower limit of the service's own stays.
bool SetLimit(__rlimit_resource_t resource, std::int64_t value, std::int64_t grace = 0) {
  struct rlimit limit {};
  if (::getrlimit(resource, &limit) != 0) return false;
  limit.rlim_max = std::min(limit.rlim_max, static_cast<rlim_t>(value + grace));
  limit.rlim_cur = std::min(limit.rlim_max, static_cast<rlim_t>(value));
  return ::setrlimit(resource, &limit) == 0;
}

}  // namespace

// The number of processes is counted by user, and in a namespace by that: elsewhere a limit would
// count what others of the user run.
bool ApplyLimits(const WorkerLimits& limits, bool own_user) {
  const bool memory = !kLimitMemory || (SetLimit(RLIMIT_DATA, limits.memory_bytes) &&
                                        SetLimit(RLIMIT_AS, limits.memory_bytes + kUnbackedBytes));
  return memory && SetLimit(RLIMIT_CPU, limits.cpu_seconds, 5) &&
         SetLimit(RLIMIT_FSIZE, limits.file_bytes) && SetLimit(RLIMIT_NOFILE, limits.open_files) &&
         SetLimit(RLIMIT_CORE, 0) && SetLimit(RLIMIT_MSGQUEUE, 0) &&
         (!own_user || SetLimit(RLIMIT_NPROC, kMostThreads));
}

// The kernel weighs ten steps of niceness a tenth, from wherever the service was put by who started
// it. More cannot be refused.
void StandBack() { [[maybe_unused]] const int now = ::nice(10); }

// Without new privileges, a program that root starts has no more capabilities than there were.
bool DropCapabilities() {
  struct __user_cap_header_struct head {
    _LINUX_CAPABILITY_VERSION_3, 0
  };
  std::array<struct __user_cap_data_struct, 2> none{};
  return ::syscall(SYS_capset, &head, none.data()) == 0 &&
         ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0;
}

void ResetSignals() {
  struct sigaction default_action {};
  default_action.sa_handler = SIG_DFL;
  for (int signal = 1; signal < NSIG; ++signal) ::sigaction(signal, &default_action, nullptr);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
}

}  // namespace farhorizon

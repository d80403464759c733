// fork and exec of a worker. Between the two the child makes only async-signal-safe calls, because
// another thread of the parent may hold a lock of the allocator at the fork. Their arguments are
// prepared before it.
#include "service/worker/child_process.h"

#include <array>
#include <cerrno>
#include <cstdlib>
#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

#include "service/worker/worker_protocol.h"

namespace farhorizon {

namespace {

constexpr int kCannotStart = 127;

#if defined(__SANITIZE_ADDRESS__)
constexpr bool kLimitAddressSpace = false;  // AddressSanitizer reserves terabytes
#else
constexpr bool kLimitAddressSpace = true;
#endif

struct Launch {
  const char* program;
  char* const* arguments;
  char* const* environment;
  const char* directory;
  int messages;
  pid_t parent;
  WorkerLimits limits;
};

bool SetLimit(int resource, std::int64_t value, std::int64_t grace = 0) {
  struct rlimit limit {};
  limit.rlim_cur = static_cast<rlim_t>(value);
  limit.rlim_max = static_cast<rlim_t>(value + grace);
  return ::setrlimit(static_cast<__rlimit_resource_t>(resource), &limit) == 0;
}

bool ApplyLimits(const Launch& launch) {
  const WorkerLimits& limits = launch.limits;
  return (!kLimitAddressSpace || SetLimit(RLIMIT_AS, limits.memory_bytes)) &&
         SetLimit(RLIMIT_CPU, limits.cpu_seconds, 5) && SetLimit(RLIMIT_FSIZE, limits.file_bytes) &&
         SetLimit(RLIMIT_NOFILE, limits.open_files) && SetLimit(RLIMIT_CORE, 0) &&
         ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0;
}

[[noreturn]] void RunInChild(const Launch& launch) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  // The parent may have died before prctl.
  if (::getppid() != launch.parent) ::_exit(kCannotStart);
  struct sigaction default_action {};
  default_action.sa_handler = SIG_DFL;
  for (int signal = 1; signal < NSIG; ++signal) ::sigaction(signal, &default_action, nullptr);
  sigset_t none;
  ::sigemptyset(&none);
  ::pthread_sigmask(SIG_SETMASK, &none, nullptr);
  ::umask(077);
  if (::chdir(launch.directory) != 0) ::_exit(kCannotStart);
  const int null = ::open("/dev/null", O_RDWR);
  const int errors = ::open("stderr.txt", O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW, 0600);
  // The pipe's descriptor may be one of those that the next lines replace.
  const int messages = ::fcntl(launch.messages, F_DUPFD, 10);
  if (null < 0 || errors < 0 || messages < 0) ::_exit(kCannotStart);
  if (::dup2(null, 0) < 0 || ::dup2(null, 1) < 0 || ::dup2(errors, 2) < 0 ||
      ::dup2(messages, kWorkerMessageFd) < 0 || ::close_range(kWorkerMessageFd + 1, ~0U, 0) != 0) {
    ::_exit(kCannotStart);
  }
  if (!ApplyLimits(launch)) ::_exit(kCannotStart);
  ::execve(launch.program, launch.arguments, launch.environment);
  ::_exit(kCannotStart);
}

// All of a worker's environment: of the parent's, only where libraries find their tables and the
// options of the sanitizers.
std::vector<std::string> Environment(const std::filesystem::path& directory) {
  std::vector<std::string> variables = {"LANG=C.UTF-8", "TMPDIR=" + directory.string(),
                                        "PROJ_NETWORK=OFF"};
  for (const char* name :
       {"PROJ_DATA", "PROJ_LIB", "GDAL_DATA", "ASAN_OPTIONS", "UBSAN_OPTIONS", "LSAN_OPTIONS"}) {
    const char* value = ::secure_getenv(name);  // NOLINT(concurrency-mt-unsafe): none is ever set
    if (value != nullptr) variables.push_back(std::string(name) + "=" + value);
  }
  return variables;
}

std::vector<char*> Pointers(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  pointers.reserve(texts.size() + 1);
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

Error CannotStart(const char* what) {
  const int cause = errno;
  const bool scarce = cause == EAGAIN || cause == ENOMEM || cause == EMFILE || cause == ENFILE;
  return {scarce ? ErrorCode::kResourceExhausted : ErrorCode::kIo,
          std::string("start a worker: ") + what + ": " + std::generic_category().message(cause),
          "worker-not-started"};
}

}  // namespace

Result<ChildProcess> ChildProcess::Start(const std::string& program,
                                         const std::vector<std::string>& arguments,
                                         const std::filesystem::path& directory,
                                         const WorkerLimits& limits) {
  std::vector<std::string> words = {program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<std::string> variables = Environment(directory);
  const std::vector<char*> argument_list = Pointers(words);
  const std::vector<char*> environment_list = Pointers(variables);
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) return CannotStart("pipe");
  UniqueFd reading(ends[0]);
  const UniqueFd writing(ends[1]);
  const Launch launch{program.c_str(),
                      argument_list.data(),
                      environment_list.data(),
                      directory.c_str(),
                      writing.get(),
                      ::getpid(),
                      limits};
  const pid_t pid = ::fork();
  if (pid < 0) return CannotStart("fork");
  if (pid == 0) RunInChild(launch);
  ::setpgid(pid, pid);  // also called by the child: whichever call is first takes effect
  // By number: glibc 2.36 declares pidfd_open without extern "C".
  UniqueFd pidfd(static_cast<int>(::syscall(SYS_pidfd_open, pid, 0)));
  ChildProcess child(pid, std::move(pidfd), std::move(reading));
  if (!child.pidfd_) return CannotStart("pidfd");
  return child;
}

ChildProcess::ChildProcess(ChildProcess&& other) noexcept
    : pid_(std::exchange(other.pid_, -1)),
      pidfd_(std::move(other.pidfd_)),
      messages_(std::move(other.messages_)) {}

ChildProcess::~ChildProcess() {
  if (pid_ <= 0) return;
  Kill();
  Wait();
}

void ChildProcess::Kill() {
  if (pid_ <= 0) return;
  ::kill(-pid_, SIGKILL);
  ::kill(pid_, SIGKILL);
}

int ChildProcess::Wait() {
  int status = 0;
  if (pid_ <= 0) return status;
  while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
  // Processes that the child started are still in its group.
  ::kill(-pid_, SIGKILL);
  pid_ = -1;
  return status;
}

}  // namespace farhorizon

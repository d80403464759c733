// Two processes: a keeper, the first of a PID namespace, and the worker below it. The first process
// of a namespace ignores signals that it has no handler for, so that the worker, which limits end
// by signals, is the second; and when the first ends, the kernel ends all others.
//
// The order within: namespaces and the private root while the keeper still has the capabilities of
// its user namespace; limits, capabilities, Landlock and system calls in the worker, the most
// powerful of the calls last.
#include "service/worker/spawner/contained_child.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <linux/capability.h>
#include <linux/sched.h>
#include <optional>
#include <poll.h>
#include <signal.h>
#include <string>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>
#include <vector>

#include "core/io/posix_file.h"
#include "service/worker/run_task.h"
#include "service/worker/sandbox/landlock.h"
#include "service/worker/sandbox/private_root.h"
#include "service/worker/spawner/worker_files.h"
#include "service/worker/worker_protocol.h"

namespace farhorizon {

namespace {

constexpr int kCannotStart = 127;
constexpr int kStatusFd = kWorkerMessageFd + 1;  // the keeper's alone

constexpr unsigned long kNamespaces = CLONE_NEWUSER | CLONE_NEWNS | CLONE_NEWPID | CLONE_NEWNET |
                                      CLONE_NEWIPC | CLONE_NEWUTS | CLONE_NEWCGROUP;
// As many threads as a worker may have, and then some: its programs start no process.
constexpr std::int64_t kMostThreads = 2048;

#if defined(__SANITIZE_ADDRESS__)
constexpr bool kLimitAddressSpace = false;  // AddressSanitizer reserves terabytes
#else
constexpr bool kLimitAddressSpace = true;
#endif

// A lower limit of the service's own stays.
bool SetLimit(__rlimit_resource_t resource, std::int64_t value, std::int64_t grace = 0) {
  struct rlimit limit {};
  if (::getrlimit(resource, &limit) != 0) return false;
  limit.rlim_max = std::min(limit.rlim_max, static_cast<rlim_t>(value + grace));
  limit.rlim_cur = std::min(limit.rlim_max, static_cast<rlim_t>(value));
  return ::setrlimit(resource, &limit) == 0;
}

// The number of processes is counted by user, and in a namespace by that: elsewhere a limit would
// count what others of the user run.
bool ApplyLimits(const WorkerLimits& limits, bool own_user) {
  return (!kLimitAddressSpace || SetLimit(RLIMIT_AS, limits.memory_bytes)) &&
         SetLimit(RLIMIT_CPU, limits.cpu_seconds, 5) && SetLimit(RLIMIT_FSIZE, limits.file_bytes) &&
         SetLimit(RLIMIT_NOFILE, limits.open_files) && SetLimit(RLIMIT_CORE, 0) &&
         SetLimit(RLIMIT_MSGQUEUE, 0) && (!own_user || SetLimit(RLIMIT_NPROC, kMostThreads));
}

// Without new privileges, a program that root starts has no more capabilities than there were.
bool DropCapabilities() {
  struct __user_cap_header_struct head {
    _LINUX_CAPABILITY_VERSION_3, 0
  };
  std::array<struct __user_cap_data_struct, 2> none{};
  return ::syscall(SYS_capset, &head, none.data()) == 0 &&
         ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0;
}

// All of a worker's environment: of the parent's, only the options of the sanitizers.
std::vector<std::string> Environment(const std::filesystem::path& directory) {
  std::vector<std::string> variables = {"LANG=C.UTF-8", "TMPDIR=" + (directory / "out").string()};
  for (const char* name : {"ASAN_OPTIONS", "UBSAN_OPTIONS"}) {
    const char* value = std::getenv(name);  // NOLINT(concurrency-mt-unsafe): one thread
    if (value != nullptr) variables.push_back(std::string(name) + "=" + value);
  }
#if defined(__SANITIZE_ADDRESS__)
  variables.emplace_back("LSAN_OPTIONS=detect_leaks=0");  // it would trace the process
#endif
  return variables;
}

std::vector<char*> Pointers(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  pointers.reserve(texts.size() + 1);
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

int RunProgram(const LaunchOrder& order) {
  std::vector<std::string> words = {order.program, "worker"};
  if (order.probe_only) words.emplace_back("--probe");
  std::vector<std::string> variables = Environment(order.directory);
  const std::vector<char*> arguments = Pointers(words);
  const std::vector<char*> environment = Pointers(variables);
  ::execve(order.program.c_str(), arguments.data(), environment.data());
  return kCannotStart;
}

void ResetSignals() {
  struct sigaction default_action {};
  default_action.sa_handler = SIG_DFL;
  for (int signal = 1; signal < NSIG; ++signal) ::sigaction(signal, &default_action, nullptr);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
}

// Both processes of a child; `status`: where the keeper reports to.
class Child {
 public:
  Child(const LaunchOrder& order, const Containment& containment, bool namespaces, unsigned user,
        unsigned group)
      : order_(order),
        containment_(containment),
        layers_{.namespaces = namespaces},
        user_(user),
        group_(group) {}

  [[noreturn]] void RunKeeper(int messages, int status) {
    ::setpgid(0, 0);
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    ResetSignals();
    ::umask(077);
    if (!TakeDescriptors(messages, status) || !ParentLives() || !EnterNamespaces()) {
      ::_exit(kCannotStart);
    }
    const pid_t keeper = ::getpid();
    const pid_t worker = ::fork();
    if (worker == 0) RunWorkerProcess(keeper);
    ::close_range(0, kStatusFd - 1, 0);
    ::prctl(PR_SET_DUMPABLE, 0);
    int ended = worker < 0 || !DropCapabilities() ? kCannotStart << 8 : WaitFor(worker);
    [[maybe_unused]] const bool told =
        WriteAll(kStatusFd, {reinterpret_cast<const char*>(&ended), sizeof(ended)});
    ::_exit(0);
  }

 private:
  bool TakeDescriptors(int messages, int status) const {
    if (::chdir(order_.directory.c_str()) != 0) return false;
    const int null = ::open("/dev/null", O_RDWR);
    const int errors = ::open("stderr.txt", O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW, 0600);
    // They may have the numbers that the next lines replace.
    const int moved_messages = ::fcntl(messages, F_DUPFD, 10);
    const int moved_status = ::fcntl(status, F_DUPFD, 10);
    return null >= 0 && errors >= 0 && moved_messages >= 0 && moved_status >= 0 &&
           ::dup2(null, 0) == 0 && ::dup2(null, 1) == 1 && ::dup2(errors, 2) == 2 &&
           ::dup2(moved_messages, kWorkerMessageFd) == kWorkerMessageFd &&
           ::dup2(moved_status, kStatusFd) == kStatusFd &&
           ::close_range(kStatusFd + 1, ~0U, 0) == 0;
  }

  // The spawner may have died before prctl; only it and the service read the status.
  static bool ParentLives() {
    struct pollfd reader {
      kStatusFd, POLLOUT, 0
    };
    return ::poll(&reader, 1, 0) == 1 && (reader.revents & POLLERR) == 0;
  }

  bool EnterNamespaces() {
    if (!layers_.namespaces) return !containment_.layers.namespaces || containment_.trial;
    if (!MapToNobody(user_, group_)) {
      layers_.namespaces = false;
      return containment_.trial;
    }
    if (!containment_.trial && !containment_.layers.private_root) return true;
    PrivateRootPlan plan{order_.directory};
    if (order_.program != kThisProgram) plan.read.emplace_back(order_.program);
    layers_.private_root = EnterPrivateRoot(plan);
    // After a failure half way the process may stand anywhere.
    return layers_.private_root || (containment_.trial && ::chdir(order_.directory.c_str()) == 0);
  }

  [[noreturn]] void RunWorkerProcess(pid_t keeper) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != keeper) ::_exit(kCannotStart);
    ::close(kStatusFd);
    const bool own_program = order_.program == kThisProgram;
    if (!ApplyLimits(order_.limits, layers_.namespaces) || !DropCapabilities()) {
      ::_exit(kCannotStart);
    }
    if (containment_.trial || containment_.layers.landlock > 0) {
      layers_.landlock = RestrictFiles(RightsOf(order_));
    }
    if (containment_.trial || containment_.layers.seccomp) {
      layers_.seccomp = RestrictSyscalls(own_program);
    }
    if (containment_.trial) ReportLayers();
    if (layers_ != containment_.layers) ::_exit(kCannotStart);
    if (!own_program) ::_exit(RunProgram(order_));
    ::prctl(PR_SET_NAME, "farhorizon-job");
    const int status = RunTask(order_.probe_only);
    std::fflush(nullptr);
    ::_exit(status);
  }

  bool RestrictSyscalls(bool own_program) const {
    const pid_t self = ::getpid();
    const SyscallFilter* ready = own_program ? containment_.own_filter : containment_.other_filter;
    if (self == kWorkerPid && ready != nullptr) return Install(*ready);
    const std::optional<SyscallFilter> made = MakeSyscallFilter(self, !own_program);
    return made && Install(*made);
  }

  [[noreturn]] void ReportLayers() const {
    const bool told =
        WriteAll(kWorkerMessageFd, {reinterpret_cast<const char*>(&layers_), sizeof(layers_)});
    ::_exit(told ? 0 : kCannotStart);
  }

  // The status of `worker`; reaps what else comes to the first process of a namespace.
  static int WaitFor(pid_t worker) {
    for (;;) {
      int status = 0;
      const pid_t ended = ::wait(&status);
      if (ended == worker) return status;
      if (ended < 0 && errno != EINTR) return kCannotStart << 8;
    }
  }

  const LaunchOrder& order_;
  Containment containment_;
  SandboxLayers layers_;
  unsigned user_;
  unsigned group_;
};

Error CannotStart(const char* what) {
  const int cause = errno;
  const bool scarce = cause == EAGAIN || cause == ENOMEM || cause == EMFILE || cause == ENFILE;
  return {scarce ? ErrorCode::kResourceExhausted : ErrorCode::kIo,
          std::string("start a worker: ") + what + ": " + std::generic_category().message(cause),
          "worker-not-started"};
}

// As fork, with the namespaces: the C library's fork takes no flags. The child's copy of the
// library then has the parent's thread id, which fork puts right for the worker.
pid_t Clone(unsigned long flags) {
  return static_cast<pid_t>(::syscall(SYS_clone, flags | SIGCHLD, nullptr, nullptr, nullptr, 0));
}

}  // namespace

Result<ContainedChild> StartContained(const LaunchOrder& order, int messages,
                                      const Containment& containment) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) return CannotStart("pipe");
  ContainedChild child;
  child.status.Reset(ends[0]);
  const UniqueFd report(ends[1]);
  const unsigned user = ::geteuid();
  const unsigned group = ::getegid();
  bool namespaces = containment.trial || containment.layers.namespaces;
  child.pid = Clone(namespaces ? kNamespaces : 0);
  if (child.pid < 0 && containment.trial) {
    namespaces = false;
    child.pid = Clone(0);
  }
  if (child.pid < 0) return CannotStart("fork");
  if (child.pid == 0) {
    Child(order, containment, namespaces, user, group).RunKeeper(messages, report.get());
  }
  ::setpgid(child.pid, child.pid);  // also called by the child: whichever is first takes effect
  // By number: glibc 2.36 declares pidfd_open without extern "C".
  child.pidfd.Reset(static_cast<int>(::syscall(SYS_pidfd_open, child.pid, 0)));
  if (!child.pidfd) {
    Error error = CannotStart("pidfd");
    ::kill(child.pid, SIGKILL);
    return error;
  }
  return child;
}

}  // namespace farhorizon

// Two processes: a keeper, the first of a PID namespace, and the worker below it. The first process
// of a namespace ignores signals that it has no handler for, so that the worker, which limits end
// by signals, is the second; and when the first ends, the kernel ends all others.
//
// Both are made before there is an order, for that takes a quarter of the time of a look at a small
// DEM. They have the database of reference systems as the spawner opened it: PROJ would open it
// anew in each process that fork made, which takes longer than the look itself, lest children
// share a file's offset. SQLite reads by pread here and PROJ's connections lock nothing, so that
// sharing does no harm: _Fork and clone do not tell PROJ. The order within: the private root while
// the worker still has the capabilities of its user namespace, then limits, capabilities, Landlock,
// and system calls, the most powerful of all, last.
#include "service/worker/spawner/contained_child.h"

#include <array>
#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <linux/sched.h>
#include <optional>
#include <poll.h>
#include <signal.h>
#include <string>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

#include "core/io/posix_file.h"
#include "service/worker/run_task.h"
#include "service/worker/sandbox/landlock.h"
#include "service/worker/sandbox/private_root.h"
#include "service/worker/spawner/fd_message.h"
#include "service/worker/spawner/process_limits.h"
#include "service/worker/spawner/run_program.h"
#include "service/worker/spawner/worker_files.h"
#include "service/worker/worker_protocol.h"

namespace farhorizon {

namespace {

constexpr int kCannotStart = 127;
// The worker's are as documented once it works; these are both processes' until then.
constexpr int kStatusFd = kWorkerMessageFd + 1;
constexpr int kOrderFd = kWorkerMessageFd + 2;

constexpr unsigned long kNamespaces = CLONE_NEWUSER | CLONE_NEWNS | CLONE_NEWPID | CLONE_NEWNET |
                                      CLONE_NEWIPC | CLONE_NEWUTS | CLONE_NEWCGROUP;

// Both processes of a child.
class Child {
 public:
  Child(const Containment& containment, bool namespaces, unsigned user, unsigned group)
      : containment_(containment), layers_{.namespaces = namespaces}, user_(user), group_(group) {}

  // status: where the keeper reports to. order: where the worker gets its order from.
  [[noreturn]] void RunKeeper(int status, int order) {
    ::setpgid(0, 0);
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    ResetSignals();
    ::umask(077);
    if (!TakeDescriptors(status, order) || !ParentLives() || !MapUser()) ::_exit(kCannotStart);
    const pid_t keeper = ::getpid();
    const bool shared = containment_.reference_data > kOrderFd;
    const pid_t worker = shared ? ::_Fork() : ::fork();
    if (worker == 0) RunWorkerProcess(keeper);
    ::prctl(PR_SET_NAME, "farhorizon-keep");
    ::close_range(0, kStatusFd - 1, 0);
    ::close_range(kOrderFd, ~0U, 0);
    ::prctl(PR_SET_DUMPABLE, 0);
    int ended = worker < 0 || !DropCapabilities() ? kCannotStart << 8 : WaitFor(worker);
    [[maybe_unused]] const bool told =
        WriteAll(kStatusFd, {reinterpret_cast<const char*>(&ended), sizeof(ended)});
    ::_exit(0);
  }

 private:
  bool TakeDescriptors(int status, int order) const {
    const int null = ::open("/dev/null", O_RDWR);
    // They may have the numbers that the next lines replace.
    const int moved_status = ::fcntl(status, F_DUPFD, 10);
    const int moved_order = ::fcntl(order, F_DUPFD, 10);
    return null >= 0 && moved_status >= 0 && moved_order >= 0 && ::dup2(null, 0) == 0 &&
           ::dup2(null, 1) == 1 && ::dup2(null, kWorkerMessageFd) == kWorkerMessageFd &&
           ::dup2(moved_status, kStatusFd) == kStatusFd &&
           ::dup2(moved_order, kOrderFd) == kOrderFd && CloseOthers();
  }

  // All after kOrderFd but the database's.
  [[nodiscard]] bool CloseOthers() const {
    const int kept = containment_.reference_data;
    if (kept <= kOrderFd) return ::close_range(kOrderFd + 1, ~0U, 0) == 0;
    const auto number = static_cast<unsigned>(kept);
    return (kept == kOrderFd + 1 || ::close_range(kOrderFd + 1, number - 1, 0) == 0) &&
           ::close_range(number + 1, ~0U, 0) == 0;
  }

  // The spawner may have died before prctl; only it and the service read the status.
  static bool ParentLives() {
    struct pollfd reader {
      kStatusFd, POLLOUT, 0
    };
    return ::poll(&reader, 1, 0) == 1 && (reader.revents & POLLERR) == 0;
  }

  bool MapUser() {
    if (!layers_.namespaces) return !containment_.layers.namespaces || containment_.trial;
    if (MapToNobody(user_, group_)) return true;
    layers_.namespaces = false;
    return containment_.trial;
  }

  [[noreturn]] void RunWorkerProcess(pid_t keeper) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != keeper) ::_exit(kCannotStart);
    ::close(kStatusFd);
    ::prctl(PR_SET_NAME, "farhorizon-wait");
    FdMessage asked = ReceiveFds(kOrderFd);
    Result<LaunchOrder> order = ReadOrder(asked.text);
    // Of a look at an upload a client waits for the answer; of a job nobody.
    if (order && !order->probe_only) StandBack();
    if (!order || asked.descriptors.size() != 1 ||
        !TakeFolder(order->directory, asked.descriptors[0].get()) || !ShutIn(*order)) {
      ::_exit(kCannotStart);
    }
    ::prctl(PR_SET_NAME, "farhorizon-job");
    asked.descriptors.clear();
    ::close(kOrderFd);
    if (containment_.trial) ReportLayers();
    if (layers_ != containment_.layers) ::_exit(kCannotStart);
    if (order->program != kThisProgram) {
      ::close_range(kWorkerMessageFd + 1, ~0U, 0);
      RunProgram(*order);
      ::_exit(kCannotStart);
    }
    const int status = RunTask(order->probe_only);
    std::fflush(nullptr);
    ::_exit(status);
  }

  static bool TakeFolder(const std::filesystem::path& directory, int messages) {
    if (::chdir(directory.c_str()) != 0) return false;
    const UniqueFd errors(
        ::open("stderr.txt", O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0600));
    return errors && ::dup2(errors.get(), 2) == 2 &&
           ::dup2(messages, kWorkerMessageFd) == kWorkerMessageFd;
  }

  bool ShutIn(const LaunchOrder& order) {
    const bool own_program = order.program == kThisProgram;
    const bool trial = containment_.trial;
    if (layers_.namespaces && (trial || containment_.layers.private_root)) {
      PrivateRootPlan plan{order.directory};
      if (!own_program) plan.read.emplace_back(order.program);
      layers_.private_root = EnterPrivateRoot(plan);
      // After a failure half way the process may stand anywhere.
      if (!layers_.private_root && (!trial || ::chdir(order.directory.c_str()) != 0)) return false;
    }
    if (!ApplyLimits(order.limits, layers_.namespaces) || !DropCapabilities()) return false;
    if (trial || containment_.layers.landlock > 0) {
      layers_.landlock = RestrictFiles(RightsOf(order));
    }
    if (trial || containment_.layers.seccomp) layers_.seccomp = RestrictSyscalls(own_program);
    return true;
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

Result<ContainedChild> StartContained(const Containment& containment) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) return CannotStart("pipe");
  ContainedChild child;
  child.status.Reset(ends[0]);
  const UniqueFd report(ends[1]);
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    return CannotStart("socket");
  }
  child.order.Reset(ends[0]);
  const UniqueFd order(ends[1]);
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
    Child(containment, namespaces, user, group).RunKeeper(report.get(), order.get());
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

bool GiveOrder(const ContainedChild& child, const LaunchOrder& order, int messages) {
  return SendFds(child.order.get(), WriteOrder(order), {messages});
}

}  // namespace farhorizon

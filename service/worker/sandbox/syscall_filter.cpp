// A list of what is allowed: a call that a later kernel brings is refused by itself. Unlisted calls
// fail with ENOSYS, as on an older kernel, so that the C library takes its older way (clone for
// clone3); those that a program may try and do without fail with EPERM.
#include "service/worker/sandbox/syscall_filter.h"

#include <array>
#include <cerrno>
#include <fcntl.h>
#include <linux/sched.h>
#include <linux/seccomp.h>
#include <memory>
#include <seccomp.h>
#include <string_view>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/io/unique_fd.h"

namespace farhorizon {

namespace {

using Filter = std::unique_ptr<void, void (*)(scmp_filter_ctx)>;

// Calls without a look at their arguments. Names that an architecture does not have are passed
// over.
constexpr std::array kAllowed = {
    // files: which of them is what Landlock and the private root decide
    "open", "openat", "close", "close_range", "read", "write", "readv", "writev", "pread64",
    "pwrite64", "preadv", "pwritev", "lseek", "_llseek", "stat", "fstat", "lstat", "stat64",
    "fstat64", "lstat64", "newfstatat", "fstatat64", "statx", "statfs", "fstatfs", "access",
    "faccessat", "faccessat2", "readlink", "readlinkat", "getdents", "getdents64", "getcwd",
    "chdir", "fchdir", "fcntl", "fcntl64", "flock", "dup", "dup2", "dup3", "pipe", "pipe2", "fsync",
    "fdatasync", "sync_file_range", "ftruncate", "ftruncate64", "truncate", "fallocate",
    "fadvise64", "rename", "renameat", "renameat2", "unlink", "unlinkat", "mkdir", "mkdirat",
    "rmdir", "fchmod", "umask", "copy_file_range", "sendfile", "readahead",
    // memory
    "brk", "mmap", "mmap2", "munmap", "mprotect", "mremap", "madvise", "msync", "mincore",
    "membarrier",
    // threads, time and signals of the process itself
    "futex", "futex_waitv", "set_robust_list", "get_robust_list", "set_tid_address", "rseq",
    "sched_yield", "sched_getaffinity", "sched_getparam", "sched_getscheduler",
    "sched_get_priority_max", "sched_get_priority_min", "getcpu", "arch_prctl", "nanosleep",
    "clock_nanosleep", "clock_gettime", "clock_getres", "gettimeofday", "time", "times", "pause",
    "alarm", "getitimer", "setitimer", "rt_sigaction", "rt_sigprocmask", "rt_sigreturn",
    "rt_sigsuspend", "rt_sigpending", "rt_sigtimedwait", "sigaltstack", "restart_syscall", "exit",
    "exit_group",
    // waiting
    "poll", "ppoll", "select", "pselect6", "_newselect", "epoll_create", "epoll_create1",
    "epoll_ctl", "epoll_wait", "epoll_pwait", "eventfd2", "timerfd_create", "timerfd_settime",
    // what the process is
    "getpid", "getppid", "gettid", "getuid", "geteuid", "getgid", "getegid", "getresuid",
    "getresgid", "getgroups", "getpgrp", "getpgid", "getsid", "uname", "sysinfo", "getrusage",
    "getrlimit", "ugetrlimit", "getrandom", "capget", "wait4", "waitid"};

// Refused as a matter of rights, so that a program says so rather than that the kernel is too old.
constexpr std::array kDenied = {"fork",
                                "vfork",
                                "execveat",
                                "socket",
                                "socketpair",
                                "connect",
                                "bind",
                                "listen",
                                "accept",
                                "accept4",
                                "sendto",
                                "sendmsg",
                                "sendmmsg",
                                "recvmsg",
                                "tkill",
                                "rt_sigqueueinfo",
                                "rt_tgsigqueueinfo",
                                "pidfd_open",
                                "pidfd_getfd",
                                "pidfd_send_signal",
                                "ptrace",
                                "process_vm_readv",
                                "process_vm_writev",
                                "process_madvise",
                                "kcmp",
                                "chmod",
                                "fchmodat",
                                "chown",
                                "fchown",
                                "lchown",
                                "fchownat",
                                "utime",
                                "utimes",
                                "utimensat",
                                "futimesat",
                                "setxattr",
                                "lsetxattr",
                                "fsetxattr",
                                "link",
                                "linkat",
                                "symlink",
                                "symlinkat",
                                "mknod",
                                "mknodat",
                                "mount",
                                "umount2",
                                "move_mount",
                                "open_tree",
                                "fsopen",
                                "mount_setattr",
                                "pivot_root",
                                "chroot",
                                "setns",
                                "unshare",
                                "name_to_handle_at",
                                "open_by_handle_at",
                                "memfd_create",
                                "userfaultfd",
                                "perf_event_open",
                                "bpf",
                                "io_uring_setup",
                                "io_uring_enter",
                                "io_uring_register",
                                "add_key",
                                "request_key",
                                "keyctl",
                                "setrlimit",
                                "setpriority",
                                "ioprio_set",
                                "sched_setaffinity",
                                "sched_setscheduler",
                                "sched_setattr",
                                "setpgid",
                                "setsid",
                                "setuid",
                                "setgid",
                                "setreuid",
                                "setregid",
                                "setresuid",
                                "setresgid",
                                "setgroups",
                                "setfsuid",
                                "setfsgid",
                                "capset",
                                "personality",
                                "shmget",
                                "shmat",
                                "semget",
                                "msgget",
                                "mq_open",
                                "inotify_init1",
                                "fanotify_init",
                                "landlock_create_ruleset"};

// Requests to terminals and pipes that standard libraries make; the others reach into drivers.
constexpr std::array<unsigned, 4> kRequests = {TCGETS, FIONREAD, FIOCLEX, FIONCLEX};
// Not among them: PR_SET_PDEATHSIG, for a worker ends with its parent.
constexpr std::array kProcessOptions = {PR_SET_NAME,     PR_GET_NAME,         PR_GET_DUMPABLE,
                                        PR_CAPBSET_READ, PR_SET_NO_NEW_PRIVS, PR_GET_SECCOMP,
                                        0x53564d41 /* PR_SET_VMA */};

class Rules {
 public:
  explicit Rules(scmp_filter_ctx filter) : filter_(filter) {}

  void Allow(const char* name) { Add(SCMP_ACT_ALLOW, name, 0, {}); }
  // Where the argument `index` has `value` under `mask`.
  void AllowWhere(const char* name, unsigned index, std::uint64_t mask, std::uint64_t value) {
    Add(SCMP_ACT_ALLOW, name, 1, SCMP_CMP(index, SCMP_CMP_MASKED_EQ, mask, value));
  }
  void Deny(const char* name) { Add(SCMP_ACT_ERRNO(EPERM), name, 0, {}); }
  void DenyWhere(const char* name, unsigned index, std::uint64_t mask, std::uint64_t value) {
    Add(SCMP_ACT_ERRNO(EPERM), name, 1, SCMP_CMP(index, SCMP_CMP_MASKED_EQ, mask, value));
  }
  void DenyWhereNot(const char* name, std::uint64_t value) {
    Add(SCMP_ACT_ERRNO(EPERM), name, 1, SCMP_CMP(0, SCMP_CMP_NE, value, 0));
  }
  [[nodiscard]] bool complete() const { return complete_; }

 private:
  void Add(std::uint32_t action, const char* name, unsigned count, struct scmp_arg_cmp where) {
    const int number = ::seccomp_syscall_resolve_name(name);
    if (number == __NR_SCMP_ERROR) return;
    complete_ = ::seccomp_rule_add_array(filter_, action, number, count, &where) == 0 && complete_;
  }

  scmp_filter_ctx filter_;
  bool complete_ = true;
};

constexpr std::uint64_t kLow32Bits = 0xffffffffU;
constexpr std::uint64_t kAllBits = ~std::uint64_t{0};

// The program, which the library gives away through a file alone.
std::optional<SyscallFilter> Exported(scmp_filter_ctx filter) {
  const UniqueFd file(::memfd_create("filter", MFD_CLOEXEC));
  struct stat about {};
  if (!file || ::seccomp_export_bpf(filter, file.get()) != 0 || ::fstat(file.get(), &about) != 0) {
    return std::nullopt;
  }
  SyscallFilter program(static_cast<std::size_t>(about.st_size) / sizeof(struct sock_filter));
  const auto bytes = static_cast<ssize_t>(program.size() * sizeof(struct sock_filter));
  if (::pread(file.get(), program.data(), static_cast<std::size_t>(bytes), 0) != bytes) {
    return std::nullopt;
  }
  return program;
}

}  // namespace

std::optional<SyscallFilter> MakeSyscallFilter(pid_t self, bool may_execute) {
  const Filter filter(::seccomp_init(SCMP_ACT_ERRNO(ENOSYS)), ::seccomp_release);
  if (!filter) return std::nullopt;
  Rules rules(filter.get());
  for (const char* name : kAllowed) rules.Allow(name);
  const auto own = static_cast<std::uint64_t>(self);
  for (const char* name : {"kill", "tgkill"}) {
    rules.AllowWhere(name, 0, kAllBits, own);
    rules.DenyWhereNot(name, own);
  }
  rules.AllowWhere("clone", 0, CLONE_THREAD, CLONE_THREAD);
  rules.DenyWhere("clone", 0, CLONE_THREAD, 0);
  // Reading limits is how libraries learn the size of the stack; only one's own can be read or set.
  for (const std::uint64_t process : {std::uint64_t{0}, own}) {
    rules.AllowWhere("prlimit64", 0, kAllBits, process);
  }
  for (const unsigned request : kRequests) rules.AllowWhere("ioctl", 1, kLow32Bits, request);
  for (const int option : kProcessOptions) {
    rules.AllowWhere("prctl", 0, kLow32Bits, static_cast<std::uint64_t>(option));
  }
  if (may_execute) {
    rules.Allow("execve");
  } else {
    rules.Deny("execve");
  }
  for (const char* name : kDenied) rules.Deny(name);
  // Calls by their numbers in a tree, not in a row.
  constexpr std::uint32_t kTree = 2;
  if (!rules.complete() || ::seccomp_attr_set(filter.get(), SCMP_FLTATR_CTL_OPTIMIZE, kTree) != 0) {
    return std::nullopt;
  }
  return Exported(filter.get());
}

bool Install(const SyscallFilter& filter) {
  struct sock_fprog program {};
  program.len = static_cast<unsigned short>(filter.size());
  program.filter = const_cast<struct sock_filter*>(filter.data());
  return ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program, 0, 0) == 0;
}

}  // namespace farhorizon

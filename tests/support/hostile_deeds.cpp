#include "tests/support/hostile_deeds.h"

#include <array>
#include <fcntl.h>
#include <filesystem>
#include <sched.h>
#include <signal.h>
#include <sys/mount.h>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

namespace farhorizon {

namespace {

namespace fs = std::filesystem;

bool Opens(const std::string& path, int flags) {
  const int fd = ::open(path.c_str(), flags | O_NONBLOCK | O_CLOEXEC, 0600);
  if (fd >= 0) ::close(fd);
  return fd >= 0;
}

bool Lists(const fs::path& path) {
  std::error_code failure;
  const fs::directory_iterator entries(path, failure);
  return !failure;
}

bool MakesSocket(int family, int kind) {
  const int fd = ::socket(family, kind, 0);
  if (fd >= 0) ::close(fd);
  return fd >= 0;
}

bool Forks() {
  const pid_t pid = ::fork();
  if (pid == 0) ::_exit(0);
  if (pid > 0) ::waitpid(pid, nullptr, 0);
  return pid > 0;
}

// As a program that looks for other calls than those that the C library makes.
bool ForksByNumber() {
  const long pid = ::syscall(SYS_clone, CLONE_PARENT | SIGCHLD, nullptr, nullptr, nullptr, 0);
  if (pid == 0) ::_exit(0);
  return pid > 0;
}

bool MakesInUring() {
  std::array<char, 120> parameters{};
  return ::syscall(SYS_io_uring_setup, 4, parameters.data()) >= 0;
}

bool ChangesModeOf(const std::string& path) { return ::chmod(path.c_str(), 0600) == 0; }

}  // namespace

std::vector<std::string> HostileDeedsDone() {
  std::vector<std::string> done;
  const auto attempt = [&done](const char* name, bool succeeded) {
    if (succeeded) done.emplace_back(name);
  };
  const std::string data = "../..";
  const pid_t parent = ::getppid();
  const std::string of_parent = "/proc/" + std::to_string(parent);
  attempt("read a file of the system", Opens("/etc/passwd", O_RDONLY));
  attempt("read the database", Opens(data + "/jobs.sqlite", O_RDONLY));
  attempt("write the database", Opens(data + "/jobs.sqlite", O_RDWR));
  attempt("lock out the service", Opens(data + "/lock", O_RDWR));
  attempt("list objects", Lists(data + "/objects"));
  attempt("list work of others", Lists(data + "/work"));
  attempt("write outside of the data folder", Opens("/tmp/farhorizon-escaped", O_CREAT | O_WRONLY));
  attempt("write beside the data folder", Opens(data + "/../escaped", O_CREAT | O_WRONLY));
  attempt("write into the working folder", Opens("escaped", O_CREAT | O_WRONLY));
  attempt("make a file in the folder of the input", Opens("in/escaped", O_CREAT | O_WRONLY));
  for (const auto& entry : fs::directory_iterator("in")) {
    attempt("write to the input", Opens(entry.path().string(), O_WRONLY));
    attempt("remove the input", ::unlink(entry.path().c_str()) == 0);
    attempt("give the input a second name", ::link(entry.path().c_str(), "out/second") == 0);
  }
  attempt("make a folder", ::mkdir("out/folder", 0700) == 0);
  attempt("make a link", ::symlink("/etc/passwd", "out/link") == 0);
  attempt("make a pipe", ::mkfifo("out/pipe", 0600) == 0);
  attempt("make a device", ::mknod("out/null", S_IFCHR | 0600, 0x103) == 0);
  attempt("change the database's mode", ChangesModeOf(data + "/jobs.sqlite"));
  attempt("TCP", MakesSocket(AF_INET, SOCK_STREAM));
  attempt("UDP of version 6", MakesSocket(AF_INET6, SOCK_DGRAM));
  attempt("a socket of the machine", MakesSocket(AF_UNIX, SOCK_STREAM));
  attempt("netlink", MakesSocket(AF_NETLINK, SOCK_RAW));
  attempt("signal the parent", ::kill(parent, 0) == 0);
  attempt("signal everybody", ::kill(-1, 0) == 0);
  attempt("trace the parent", ::ptrace(PTRACE_ATTACH, parent, nullptr, nullptr) == 0);
  attempt("read the parent's memory", Opens(of_parent + "/mem", O_RDONLY));
  attempt("read the parent's environment", Opens(of_parent + "/environ", O_RDONLY));
  attempt("start a process", Forks());
  attempt("start a process by number", ForksByNumber());
  attempt("leave its session", ::setsid() >= 0);
  attempt("outlive its parent", ::prctl(PR_SET_PDEATHSIG, 0) == 0);
  attempt("a file in memory", ::syscall(SYS_memfd_create, "x", 0) >= 0);
  attempt("a user namespace", ::unshare(CLONE_NEWUSER) == 0);
  attempt("mount", ::mount("x", "/tmp", "tmpfs", 0, nullptr) == 0);
  attempt("io_uring", MakesInUring());
  attempt("a key", ::syscall(SYS_add_key, "user", "x", "y", 1, -3) >= 0);
  attempt("programs for the kernel", ::syscall(SYS_bpf, 0, nullptr, 0) >= 0);
  struct rlimit more {};
  more.rlim_cur = more.rlim_max = RLIM_INFINITY;
  attempt("more memory", ::setrlimit(RLIMIT_AS, &more) == 0);
  const char* const words[] = {"true", nullptr};
  ::execve("/bin/true", const_cast<char* const*>(words), nullptr);  // ends the list where it can
  return done;
}

}  // namespace farhorizon

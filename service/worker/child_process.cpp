#include "service/worker/child_process.h"

#include <cerrno>
#include <poll.h>
#include <signal.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace farhorizon {

ChildProcess::ChildProcess(ChildProcess&& other) noexcept
    : pid_(std::exchange(other.pid_, -1)),
      pidfd_(std::move(other.pidfd_)),
      status_(std::move(other.status_)),
      messages_(std::move(other.messages_)) {}

ChildProcess::~ChildProcess() {
  if (pid_ <= 0) return;
  Kill();
  Wait();
}

void ChildProcess::Kill() {
  if (pid_ <= 0) return;
  // By number: glibc 2.36 declares pidfd_send_signal without extern "C". The group by its number,
  // which nobody else has before the keeper, reaped by the spawner, has ended.
  const bool alive = ::syscall(SYS_pidfd_send_signal, pidfd_.get(), 0, nullptr, 0) == 0;
  if (alive) ::kill(-pid_, SIGKILL);
  ::syscall(SYS_pidfd_send_signal, pidfd_.get(), SIGKILL, nullptr, 0);
}

int ChildProcess::Wait() {
  if (pid_ <= 0) return 0;
  struct pollfd ended {
    pidfd_.get(), POLLIN, 0
  };
  while (::poll(&ended, 1, -1) < 0 && errno == EINTR) {
  }
  pid_ = -1;
  int status = SIGKILL;
  // Whole or not at all: a pipe takes so few bytes at once.
  return ::read(status_.get(), &status, sizeof(status)) == sizeof(status) ? status : SIGKILL;
}

}  // namespace farhorizon

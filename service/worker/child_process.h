#pragma once

#include <sys/types.h>
#include <utility>

#include "core/io/unique_fd.h"

namespace farhorizon {

/// A worker process that a Spawner started, killed with this object.
class ChildProcess {
 public:
  /// pid, pidfd: of its keeper, of whose group it is. status, messages: the read ends of its pipes.
  ChildProcess(pid_t pid, UniqueFd pidfd, UniqueFd status, UniqueFd messages)
      : pid_(pid),
        pidfd_(std::move(pidfd)),
        status_(std::move(status)),
        messages_(std::move(messages)) {}
  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess& operator=(ChildProcess&&) = delete;
  ~ChildProcess();

  /// The descriptor from which the child's messages are read.
  [[nodiscard]] int message_fd() const { return messages_.get(); }
  /// A descriptor that becomes readable when the child has ended, and all that it started.
  [[nodiscard]] int pidfd() const { return pidfd_.get(); }

  /// Kills the child and the other processes of its group.
  void Kill();
  /// Waits for the end of the child; its status as of waitpid, that of SIGKILL where its keeper was
  /// killed.
  int Wait();

 private:
  pid_t pid_;
  UniqueFd pidfd_;
  UniqueFd status_;
  UniqueFd messages_;
};

}  // namespace farhorizon

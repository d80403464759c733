#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <sys/types.h>
#include <vector>

#include "core/base/result.h"
#include "core/io/unique_fd.h"

namespace farhorizon {

/// Limits of a worker's resources. The kernel enforces them, except wall_seconds, which RunWorker
/// does.
struct WorkerLimits {
  /// Of address space; not enforced under AddressSanitizer.
  std::int64_t memory_bytes = std::int64_t{1} << 32U;
  std::int64_t cpu_seconds = 3600;
  std::int64_t wall_seconds = 3600;
  std::int64_t file_bytes = std::int64_t{1} << 33U;  ///< of each file it writes
  std::int64_t open_files = 128;
};

/// A started child process in its own process group, killed and reaped with this object.
///
/// The child has: /dev/null as standard input and output, the file `stderr.txt` of its directory as
/// standard error, a pipe as descriptor kWorkerMessageFd, no other descriptor; a fixed list of
/// environment variables; its limits, no core dump, no new privileges. The kernel kills the child
/// when the thread that started it ends.
class ChildProcess {
 public:
  /// Errors: kIo, kResourceExhausted where the system gives no process or pipe.
  static Result<ChildProcess> Start(const std::string& program,
                                    const std::vector<std::string>& arguments,
                                    const std::filesystem::path& directory,
                                    const WorkerLimits& limits);

  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess& operator=(ChildProcess&&) = delete;
  ~ChildProcess();

  /// The descriptor from which the child's messages are read.
  [[nodiscard]] int message_fd() const { return messages_.get(); }
  /// A descriptor that becomes readable when the child ends.
  [[nodiscard]] int pidfd() const { return pidfd_.get(); }

  /// Kills the child and the other processes of its group.
  void Kill();
  /// Waits for the end of the child, then kills the rest of its group; the status as of waitpid.
  int Wait();

 private:
  ChildProcess(pid_t pid, UniqueFd pidfd, UniqueFd messages)
      : pid_(pid), pidfd_(std::move(pidfd)), messages_(std::move(messages)) {}

  pid_t pid_;
  UniqueFd pidfd_;
  UniqueFd messages_;
};

}  // namespace farhorizon

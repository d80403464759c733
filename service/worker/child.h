#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <sys/types.h>
#include <vector>

#include "core/base/result.h"
#include "service/unique_fd.h"

namespace farhorizon {

/// What a worker may use; enforced by the kernel.
struct WorkerLimits {
  std::int64_t memory_bytes = 0;  ///< of address space; not enforced under AddressSanitizer
  std::int64_t cpu_seconds = 0;
  std::int64_t wall_seconds = 0;
  std::int64_t file_bytes = 0;  ///< of each file it writes
  std::int64_t open_files = 128;
};

/// A started child process in its own process group, killed and reaped with this object.
///
/// The child has: /dev/null as standard input and output, the file `stderr.txt` of its directory as
/// standard error, the pipe as descriptor 3, no other descriptor; a closed environment; its limits,
/// no core dump, no new privileges; and it dies with the thread that started it.
class Child {
 public:
  /// Errors: kIo, kResourceExhausted where the system gives no process or pipe.
  static Result<Child> Start(const std::string& program, const std::vector<std::string>& arguments,
                             const std::filesystem::path& directory, const WorkerLimits& limits);

  Child(Child&& other) noexcept;
  Child& operator=(Child&&) = delete;
  ~Child();

  /// The end to read its messages from.
  [[nodiscard]] int messages() const { return messages_.get(); }
  /// Readable once it has ended.
  [[nodiscard]] int end() const { return pidfd_.get(); }
  [[nodiscard]] pid_t pid() const { return pid_; }

  /// Kills it and whatever it started.
  void Kill();
  /// Waits for its end; the status as of waitpid.
  int Wait();

 private:
  Child(pid_t pid, UniqueFd pidfd, UniqueFd messages)
      : pid_(pid), pidfd_(std::move(pidfd)), messages_(std::move(messages)) {}

  pid_t pid_;
  UniqueFd pidfd_;
  UniqueFd messages_;
};

}  // namespace farhorizon

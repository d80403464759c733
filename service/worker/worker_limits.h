#pragma once

#include <cstdint>

namespace farhorizon {

/// Limits of a worker's resources. The kernel enforces them, except wall_seconds, which RunWorker
/// does.
struct WorkerLimits {
  /// Of what only this process can write to: its heaps and stacks, not the pages of its program and
  /// of files. Not enforced under AddressSanitizer.
  std::int64_t memory_bytes = std::int64_t{1} << 32U;
  std::int64_t cpu_seconds = 3600;
  std::int64_t wall_seconds = 3600;
  std::int64_t file_bytes = std::int64_t{1} << 33U;  ///< of each file it writes
  std::int64_t open_files = 128;
  /// Of all files that it adds to its folder. RunWorker looks every second.
  std::int64_t folder_bytes = std::int64_t{1} << 34U;
  /// What wall_seconds are, for who is told that they were not enough.
  const char* wall_bound = "what a job may take here";
};

}  // namespace farhorizon

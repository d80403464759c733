#pragma once

#include <cstdint>

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

}  // namespace farhorizon

#pragma once

#include <cstdint>

namespace farhorizon {

/// What the system knows of this process; 0 where it does not say.
struct ProcessInfo {
  double cpu_seconds = 0;    ///< of all threads
  double start_seconds = 0;  ///< since 1970
  std::int64_t resident_bytes = 0;
  std::int64_t open_files = 0;
  std::int64_t most_files = 0;
};

ProcessInfo ReadProcessInfo();

}  // namespace farhorizon

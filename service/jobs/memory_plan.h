#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/base/result.h"

namespace farhorizon {

/// What the configuration and the machine say of memory.
struct MemoryWishes {
  std::optional<std::int64_t> machine_bytes;  ///< as MachineMemoryBytes has it
  std::int64_t budget_bytes = 0;              ///< of workers and probes together; 0: the machine's
  std::int64_t worker_bytes = 0;              ///< of one worker, at most
  std::int64_t probe_bytes = 0;               ///< of one probe, at most
  int workers = 1;
  int probes = 0;  ///< at once; 0: as many as workers, as far as there is memory
};

/// How the memory is shared out. The limits of all probes and of all workers that run at once
/// are together at most the budget.
struct MemoryPlan {
  std::int64_t jobs_bytes = 0;  ///< of all workers together
  std::int64_t job_bytes = 0;   ///< of one at most
  std::int64_t probe_bytes = 0;
  int probes = 1;
};

/// "256 MiB": rounded up, for messages.
std::string Mebibytes(std::int64_t bytes);

/// Errors: kInvalidArgument "invalid-config" where nothing is left for the smallest job.
Result<MemoryPlan> PlanMemory(const MemoryWishes& wishes);

}  // namespace farhorizon

#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "service/worker/worker_limits.h"

namespace farhorizon {

/// The worker.program that stands for this program itself.
constexpr const char* kThisProgram = "/proc/self/exe";

/// What the service asks of its spawner: one worker process.
struct LaunchOrder {
  std::string program = kThisProgram;
  bool probe_only = false;
  std::filesystem::path directory;  ///< absolute
  WorkerLimits limits;
};

std::string WriteOrder(const LaunchOrder& order);
/// Errors: kInvalidArgument.
Result<LaunchOrder> ReadOrder(std::string_view text);

}  // namespace farhorizon

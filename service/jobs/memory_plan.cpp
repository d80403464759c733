#include "service/jobs/memory_plan.h"

#include <algorithm>
#include <string>

#include "core/pipeline/build_cost.h"

namespace farhorizon {

namespace {

constexpr std::int64_t kMebibyte = std::int64_t{1} << 20U;
// The service and the process that starts workers take 30 MiB and 20, uploads and answers on their
// way some more, and the pages of the program and its libraries that all workers share 42. The
// kernel's own, and the files that the disk is to keep at hand, grow with the machine.
constexpr std::int64_t kOwnBytes = 128 * kMebibyte;
constexpr std::int64_t kOwnShare = 16;
// Tiles of this size are what services are mostly sent.
constexpr std::int64_t kSmallestPosts = 257 * 257;
// A probe is a convenience: it takes a quarter of the memory at most, unless one would be none.
constexpr std::int64_t kProbesShare = 4;
constexpr std::int64_t kLeastOfProbe = 96 * kMebibyte;

}  // namespace

std::string Mebibytes(std::int64_t bytes) {
  return std::to_string((bytes + kMebibyte - 1) / kMebibyte) + " MiB";
}

Result<MemoryPlan> PlanMemory(const MemoryWishes& wishes) {
  std::int64_t budget = wishes.budget_bytes;
  const std::int64_t machine = wishes.machine_bytes.value_or(0);
  if (budget == 0 && machine > 0) budget = machine - kOwnBytes - machine / kOwnShare;
  if (budget == 0) {  // nobody knows: the limits of each are all that there is
    budget = wishes.workers * (wishes.worker_bytes + wishes.probe_bytes);
  }
  MemoryPlan plan;
  const std::int64_t for_probes = budget / kProbesShare;
  const std::int64_t fit =
      std::max<std::int64_t>(1, for_probes / std::max<std::int64_t>(1, wishes.probe_bytes));
  plan.probes = wishes.probes > 0
                    ? wishes.probes
                    : static_cast<int>(std::clamp<std::int64_t>(wishes.workers, 1, fit));
  plan.probe_bytes =
      std::min(wishes.probe_bytes, std::max(kLeastOfProbe, for_probes / plan.probes));
  plan.jobs_bytes = budget - plan.probes * plan.probe_bytes;
  plan.job_bytes = std::min(wishes.worker_bytes, plan.jobs_bytes);
  const std::int64_t least = EstimateBuild(kSmallestPosts, {}).memory_bytes;
  if (plan.job_bytes >= least) return plan;
  return Error{
      ErrorCode::kInvalidArgument,
      "of " + Mebibytes(wishes.budget_bytes > 0 ? budget : machine) +
          (wishes.budget_bytes > 0 ? " (jobs.memoryBytes)"
                                   : " of memory, as the machine or its control group has") +
          ", " + Mebibytes(std::max<std::int64_t>(0, plan.job_bytes)) +
          " are left for a job beside the service and " + std::to_string(plan.probes) +
          " probes of " + Mebibytes(plan.probe_bytes) + "; a small one needs " + Mebibytes(least) +
          ": give the service more",
      "invalid-config"};
}

}  // namespace farhorizon

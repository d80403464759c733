#include "service/jobs/memory_plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace farhorizon {
namespace {

constexpr std::int64_t kMebibyte = std::int64_t{1} << 20U;
constexpr std::int64_t kGibibyte = 1024 * kMebibyte;

MemoryWishes On(std::int64_t machine, int workers = 2) {
  return {machine, 0, 4 * kGibibyte, 256 * kMebibyte, workers, 0};
}

TEST(MemoryPlan, AllLimitsTogetherStayBelowTheMachines) {
  for (const std::int64_t machine :
       {400 * kMebibyte, 512 * kMebibyte, kGibibyte, 2 * kGibibyte, 24 * kGibibyte}) {
    for (const int workers : {1, 2, 4, 64}) {
      const auto plan = PlanMemory(On(machine, workers));
      ASSERT_TRUE(plan) << plan.error().message;
      EXPECT_LE(plan->jobs_bytes + plan->probes * plan->probe_bytes, machine - 128 * kMebibyte);
      EXPECT_LE(plan->job_bytes, plan->jobs_bytes);
      EXPECT_GE(plan->probes, 1);
      EXPECT_LE(plan->probes, workers);
    }
  }
}

TEST(MemoryPlan, GivesWhatIsAskedForWhereThereIsEnough) {
  const auto plan = PlanMemory(On(24 * kGibibyte));
  ASSERT_TRUE(plan);
  EXPECT_EQ(plan->job_bytes, 4 * kGibibyte);
  EXPECT_EQ(plan->probe_bytes, 256 * kMebibyte);
  EXPECT_EQ(plan->probes, 2);
}

TEST(MemoryPlan, TakesTheConfiguredBudgetAndProbes) {
  MemoryWishes wishes = On(24 * kGibibyte);
  wishes.budget_bytes = kGibibyte;
  wishes.probes = 3;
  const auto plan = PlanMemory(wishes);
  ASSERT_TRUE(plan);
  EXPECT_EQ(plan->probes, 3);
  EXPECT_EQ(plan->jobs_bytes + 3 * plan->probe_bytes, kGibibyte);
}

TEST(MemoryPlan, RefusesWhatIsTooSmallForASmallJobWithTheFigures) {
  const auto plan = PlanMemory(On(256 * kMebibyte));
  ASSERT_FALSE(plan);
  EXPECT_EQ(plan.error().kind, "invalid-config");
  EXPECT_THAT(plan.error().message, testing::HasSubstr("256 MiB of memory"));
  MemoryWishes wishes = On(24 * kGibibyte);
  wishes.budget_bytes = 100 * kMebibyte;
  EXPECT_THAT(PlanMemory(wishes).error().message, testing::HasSubstr("(jobs.memoryBytes)"));
}

TEST(MemoryPlan, WithoutAKnownMachineTheLimitsOfEachCount) {
  MemoryWishes wishes = On(0);
  wishes.machine_bytes.reset();
  const auto plan = PlanMemory(wishes);
  ASSERT_TRUE(plan);
  EXPECT_EQ(plan->jobs_bytes, 8 * kGibibyte);
}

}  // namespace
}  // namespace farhorizon

#include "core/horizon/budgeted_work.h"

#include <atomic>
#include <memory>
#include <stop_token>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace farhorizon {
namespace {

// Items that take 1 + i % 7 decisions each, but for every 100th, which takes a thousand.
constexpr std::size_t kItems = 1000;

std::int64_t CostOf(std::size_t i) {
  return i % 100 == 0 ? 1000 : 1 + static_cast<std::int64_t>(i % 7);
}

std::int64_t CostOfAll() {
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < kItems; ++i) sum += CostOf(i);
  return sum;
}

BudgetedWork::Done Attempt(std::span<const std::size_t> items, std::int64_t limit) {
  BudgetedWork::Done done;
  for (const std::size_t i : items) {
    done.spent += std::min(CostOf(i), limit);
    if (CostOf(i) > limit) done.open.push_back(i);
  }
  return done;
}

BudgetedWork Counting() { return {.count = kItems, .attempt = Attempt, .what = "counting"}; }

TEST(BudgetedWork, IsDoneWhereTheBudgetJustSuffices) {
  for (const bool approximate : {false, true}) {
    for (const int threads : {1, 3}) {
      WorkBudget budget(CostOfAll(), approximate);
      Result<std::vector<std::size_t>> open = WorkThrough(Counting(), threads, budget, {});
      ASSERT_TRUE(open);
      EXPECT_THAT(*open, testing::IsEmpty());
      EXPECT_EQ(budget.left(), 0);
      EXPECT_FALSE(budget.IsShort());
    }
  }
}

TEST(BudgetedWork, EndsWithAnErrorOneDecisionBelowThat) {
  for (const int threads : {1, 3}) {
    WorkBudget budget(CostOfAll() - 1);
    Result<std::vector<std::size_t>> open = WorkThrough(Counting(), threads, budget, {});
    ASSERT_FALSE(open);
    EXPECT_EQ(open.error().kind, "work-budget");
    EXPECT_THAT(open.error().message, testing::StartsWith("counting takes more"));
  }
}

TEST(BudgetedWork, LeavesTheHardestOpenWhereItIsShort) {
  for (const int threads : {1, 3}) {
    WorkBudget budget(CostOfAll() - 1, true);
    std::atomic<int> restarts = 0;
    BudgetedWork work = Counting();
    work.restart = [&restarts] { ++restarts; };
    const std::vector<std::size_t> open = *WorkThrough(work, threads, budget, {});
    EXPECT_THAT(open, testing::ElementsAre(0, 100, 200, 300, 400, 500, 600, 700, 800, 900));
    EXPECT_EQ(restarts, 1);
    EXPECT_TRUE(budget.IsShort());
    EXPECT_FALSE(budget.IsExceeded()) << "what was thrown away does not count";
  }
}

TEST(BudgetedWork, LeavesLaterStagesTheirShare) {
  WorkBudget budget(1500, true);
  budget.Rewind(0);
  BudgetedWork work = Counting();
  work.share = 0.5;
  EXPECT_EQ(WorkThrough(work, 1, budget, {})->size(), kItems) << "no part is as much as a decision";
  EXPECT_EQ(budget.left(), 1500);
  work.count = 100;
  EXPECT_THAT(*WorkThrough(work, 1, budget, {}), testing::ElementsAre(0));
  EXPECT_GE(budget.left(), 750);
}

TEST(BudgetedWork, EndsWhereThereIsNothingToDo) {
  WorkBudget budget(0);
  BudgetedWork work = Counting();
  work.count = 0;
  EXPECT_TRUE(WorkThrough(work, 2, budget, {}));
}

TEST(BudgetedWork, StopsWhenAskedTo) {
  // On the heap: g++ 12 takes one on the stack for uninitialised here.
  const auto source = std::make_unique<std::stop_source>();
  source->request_stop();
  RunControl control;
  control.stop = source->get_token();
  WorkBudget budget(CostOfAll());
  Result<std::vector<std::size_t>> open = WorkThrough(Counting(), 2, budget, control);
  ASSERT_FALSE(open);
  EXPECT_EQ(open.error().code, ErrorCode::kCancelled);
}

}  // namespace
}  // namespace farhorizon

#include "service/jobs/job_changes.h"

#include <memory>
#include <vector>

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

TEST(JobChanges, WakesWhoWaitsForTheJobAndNobodyElse) {
  const auto changes = std::make_shared<JobChanges>(8);
  int first = 0;
  int second = 0;
  auto one = changes->Add("a", "x");
  const auto other = changes->Add("b", "x");
  changes->Tell("a");  // nobody listens yet
  one->Listen([&] { ++first; });
  other->Listen([&] { ++second; });
  changes->Tell("a");
  changes->Tell("c");
  EXPECT_EQ(first, 1);
  EXPECT_EQ(second, 0);
  changes->Tell("");
  EXPECT_EQ(first, 2);
  EXPECT_EQ(second, 1);
  one.reset();
  changes->Tell("a");
  EXPECT_EQ(first, 2);
}

TEST(JobChanges, CountsWatchesAndKeepsRoomForOtherClients) {
  const auto changes = std::make_shared<JobChanges>(8);
  std::vector<std::unique_ptr<JobChanges::Watch>> watches;
  for (int i = 0; i < 7; ++i) watches.push_back(changes->Add("a", "greedy"));
  ASSERT_NE(watches.back(), nullptr);
  EXPECT_EQ(changes->Add("a", "greedy"), nullptr);
  watches.push_back(changes->Add("a", "other"));
  ASSERT_NE(watches.back(), nullptr);
  EXPECT_EQ(changes->Add("a", "third"), nullptr);
  EXPECT_EQ(changes->Count(), 8);
  watches.erase(watches.begin());
  EXPECT_NE(changes->Add("a", "third"), nullptr);
  watches.clear();
  EXPECT_EQ(changes->Count(), 0);
}

TEST(JobChanges, AWatchMayOutliveTheServiceThatGaveIt) {
  auto changes = std::make_shared<JobChanges>(8);
  const auto watch = changes->Add("a", "x");
  changes.reset();
  watch->Listen([] {});
}

}  // namespace
}  // namespace farhorizon

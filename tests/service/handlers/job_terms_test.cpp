#include "service/handlers/job_terms.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace farhorizon {
namespace {

TEST(JobTerms, TakesTheTermsAndLeavesTheRest) {
  Parameters parameters = {
      {"priority", "high"}, {"deadline", "600"}, {"timeout", "3e1"}, {"levels", "2"}};
  const auto terms = TakeTerms(parameters, {});
  ASSERT_TRUE(terms);
  EXPECT_EQ(terms->priority, Priority::kHigh);
  EXPECT_EQ(terms->deadline_seconds, 600);
  EXPECT_EQ(terms->timeout_seconds, 30);
  EXPECT_EQ(parameters, (Parameters{{"levels", "2"}}));
}

TEST(JobTerms, WithoutThemTheConfigurationsCount) {
  Parameters none;
  const auto terms = TakeTerms(none, {Priority::kLow, 100, 50});
  ASSERT_TRUE(terms);
  EXPECT_EQ(terms->priority, Priority::kLow) << "no higher one may be had";
  EXPECT_EQ(terms->deadline_seconds, 50);
  EXPECT_EQ(terms->timeout_seconds, 0);
  EXPECT_EQ(TakeTerms(none, {})->priority, Priority::kNormal);
}

TEST(JobTerms, RefusesWhatIsBeyondTheBoundsAndSaysThem) {
  struct Case {
    const char* name;
    const char* value;
    const char* said;
  };
  for (const Case& c : {Case{"priority", "high", "low or normal"}, Case{"priority", "", "low"},
                        Case{"priority", "2", "low"}, Case{"timeout", "101", "from 1 to 100"},
                        Case{"timeout", "0", "from 1 to 100"}, Case{"timeout", "soon", "whole"},
                        Case{"deadline", "-1", "from 1 to"}, Case{"deadline", "1.5", "whole"},
                        Case{"deadline", "1e30", "from 1 to"}}) {
    Parameters parameters = {{c.name, c.value}};
    const auto terms = TakeTerms(parameters, {Priority::kNormal, 100, 0});
    ASSERT_FALSE(terms) << c.name << "=" << c.value;
    EXPECT_EQ(terms.error().kind, "invalid-parameter");
    EXPECT_THAT(terms.error().message, testing::HasSubstr(c.said));
  }
}

}  // namespace
}  // namespace farhorizon

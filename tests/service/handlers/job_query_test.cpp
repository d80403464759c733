#include "service/handlers/job_query.h"

#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace farhorizon {
namespace {

using Span = std::pair<std::int64_t, std::int64_t>;

TEST(InstantIn, ReadsTimesAndTheirLength) {
  EXPECT_EQ(InstantIn("1970-01-01T00:00:01Z"), (Span{1000, 1999}));
  EXPECT_EQ(InstantIn("1970-01-01T00:00:01.25Z"), (Span{1250, 1250}));
  EXPECT_EQ(InstantIn("1970-01-01T01:00:00.000123+01:00"), (Span{0, 0}));
  EXPECT_EQ(InstantIn("1969-12-31T23:00:00-01:00"), (Span{0, 999}));
  EXPECT_EQ(InstantIn("1970-01-02"), (Span{86'400'000, 172'799'999}));
  for (const char* text : {"", "..", "1970", "1970-13-01", "1970-02-30", "1970-01-01T",
                           "1970-01-01T00:00:01", "1970-01-01T24:00:00Z", "1970-01-01T00:00:01.Z",
                           "1970-01-01T00:00:01+1", "1970-01-01 x", "+970-01-01"}) {
    EXPECT_FALSE(InstantIn(text)) << text;
  }
}

TEST(ReadJobQuery, ReadsEveryFilter) {
  const auto read = ReadJobQuery({{"datetime", "../1970-01-01T00:00:01Z"},
                                  {"maxDuration", "7"},
                                  {"minDuration", "2"},
                                  {"processID", "a,b"},
                                  {"status", "running,failed"},
                                  {"type", "process"}},
                                 5000);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_FALSE(read->none);
  const JobQuery& query = read->query;
  EXPECT_EQ(query.processes, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(query.states, (std::vector<JobState>{JobState::kRunning, JobState::kFailed}));
  EXPECT_FALSE(query.created_from_ms);
  EXPECT_EQ(query.created_to_ms, 1999);
  EXPECT_EQ(query.least_duration_ms, 2000);
  EXPECT_EQ(query.most_duration_ms, 7000);
  EXPECT_EQ(query.now_ms, 5000);
  EXPECT_TRUE(ReadJobQuery({{"type", "other"}}, 0)->none);
  EXPECT_EQ(ReadJobQuery({{"datetime", "1970-01-02/"}}, 0)->query.created_from_ms, 86'400'000);
}

TEST(ReadJobQuery, RefusesWhatItCannotRead) {
  for (const auto& [name, value] :
       std::vector<std::pair<std::string, std::string>>{{"datetime", ".."},
                                                        {"datetime", "../.."},
                                                        {"datetime", "x/1970-01-02"},
                                                        {"datetime", "1970-01-02/x"},
                                                        {"minDuration", "-1"},
                                                        {"maxDuration", "x"},
                                                        {"minDuration", "99999999999999"},
                                                        {"status", "done"},
                                                        {"other", "1"}}) {
    const auto read = ReadJobQuery({{name, value}}, 0);
    EXPECT_FALSE(read) << name << "=" << value;
  }
}

}  // namespace
}  // namespace farhorizon

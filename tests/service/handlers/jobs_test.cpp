#include "service/handlers/jobs.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/handlers_fixture.h"

namespace farhorizon {
namespace {

using nlohmann::json;

using JobsTest = HandlersTest;

TEST_F(JobsTest, KnowsNoJobByAnyOtherName) {
  for (const char* id : {"x", "..%2f..%2fetc", "%00", "0190f1e2-0000-7000-8000-000000000000"}) {
    EXPECT_EQ(Send("GET", std::string("/jobs/") + id).status, 404) << id;
  }
}

TEST_F(JobsTest, PagesByLinks) {
  Post("/jobs", tiff_);
  Post("/jobs", tiff_);
  json page = json::parse(Send("GET", "/jobs?limit=1").body);
  EXPECT_EQ(page["jobs"].size(), 1U);
  ASSERT_EQ(page["links"].size(), 2U);
  EXPECT_EQ(page["links"][1]["rel"], "next");
  const std::string next = page["links"][1].value("href", "").substr(8);
  EXPECT_EQ(json::parse(Send("GET", next).body)["links"].size(), 1U);
  EXPECT_EQ(json::parse(Send("GET", "/jobs?limit=1.0").body)["jobs"].size(), 1U);
  const HttpResponse several = Send("GET", "/jobs?status=running&status=accepted");
  EXPECT_EQ(json::parse(several.body)["jobs"].size(), 2U) << several.body;
  for (const char* query :
       {"limit=0", "limit=10001", "limit=1.5", "limit=a", "status=done", "x=1", "cursor=1"}) {
    EXPECT_EQ(CodeOf(Send("GET", std::string("/jobs?") + query)), "invalid-query-parameter-value")
        << query;
  }
}

}  // namespace
}  // namespace farhorizon

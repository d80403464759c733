#include "service/handlers/capabilities.h"

#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/handlers_fixture.h"

namespace farhorizon {
namespace {

using nlohmann::json;

using CapabilitiesTest = HandlersTest;

TEST_F(CapabilitiesTest, LeadFromTheLandingPageToEverything) {
  const json landing = json::parse(Send("GET", "/").body);
  std::set<std::string> relations;
  for (const json& link : landing["links"]) {
    relations.insert(link["rel"].get<std::string>());
    const std::string href = link["href"].get<std::string>();
    ASSERT_EQ(href.rfind("http://x/", 0), 0U) << href;
    const HttpResponse answer = Send("GET", href.substr(8));
    EXPECT_EQ(answer.status, 200) << href;
    if (link["type"] != "text/html") {
      EXPECT_EQ(FieldOf(answer, "Content-Type"), link["type"]) << href;
    }
  }
  for (const char* name : {"conformance", "processes", "job-list"}) {
    EXPECT_EQ(relations.count(std::string("http://www.opengis.net/def/rel/ogc/1.0/") + name), 1U)
        << name;
  }
  EXPECT_EQ(relations.count("service-desc"), 1U);
}

TEST_F(CapabilitiesTest, HasTheApiInTwoVersions) {
  EXPECT_EQ(json::parse(Send("GET", "/api").body)["openapi"], "3.1.0");
  EXPECT_EQ(json::parse(Send("GET", "/api?v=3.1").body)["openapi"], "3.1.0");
  EXPECT_EQ(json::parse(Send("GET", "/api?v=3.0").body)["openapi"], "3.0.3");
  for (const char* query : {"v=2.0", "x=1", "v=3.0&v=3.1", "v=3.0&x=1"}) {
    EXPECT_EQ(CodeOf(Send("GET", std::string("/api?") + query)), "invalid-query-parameter-value")
        << query;
  }
}

}  // namespace
}  // namespace farhorizon

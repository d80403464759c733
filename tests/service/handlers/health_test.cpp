#include "service/handlers/health.h"

#include <gtest/gtest.h>

#include "tests/support/handlers_fixture.h"

namespace farhorizon {
namespace {

using HealthTest = HandlersTest;

TEST_F(HealthTest, TakesNothingWhileItDrains) {
  EXPECT_EQ(Send("GET", "/readyz").status, 200);
  jobs_->Drain();
  EXPECT_EQ(CodeOf(Post("/jobs", tiff_)), "draining");
  const HttpResponse ready = Send("GET", "/readyz");
  EXPECT_EQ(ready.status, 503);
  EXPECT_EQ(CodeOf(ready), "draining");
  const auto checks = nlohmann::json::parse(ready.body)["checks"];
  ASSERT_EQ(checks.size(), 3U);
  EXPECT_EQ(checks[0]["name"], "accepting");
  EXPECT_EQ(checks[0]["code"], "draining");
  EXPECT_EQ(checks[1]["ok"], true);
  EXPECT_EQ(Send("GET", "/healthz").status, 200);
}

TEST_F(HealthTest, ShowsItsMetrics) {
  Post("/jobs", tiff_);
  const HttpResponse response = Send("GET", "/metrics");
  EXPECT_EQ(response.status, 200);
  EXPECT_EQ(FieldOf(response, "Content-Type"), "text/plain; version=0.0.4; charset=utf-8");
  EXPECT_NE(response.body.find("farhorizon_jobs{state=\"accepted\"} 1\n"), std::string::npos);
  EXPECT_NE(response.body.find("farhorizon_ready 1\n"), std::string::npos);
}

}  // namespace
}  // namespace farhorizon

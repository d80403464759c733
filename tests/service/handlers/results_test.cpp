#include "service/handlers/results.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/handlers_fixture.h"

namespace farhorizon {
namespace {

using nlohmann::json;

using ResultsTest = HandlersTest;

TEST_F(ResultsTest, HasNoResultsBeforeTheEnd) {
  const std::string path = "/jobs/" + json::parse(Post("/jobs", tiff_).body).value("jobID", "");
  const HttpResponse early = Send("GET", path + "/results");
  EXPECT_EQ(early.status, 404);
  EXPECT_EQ(json::parse(early.body)["type"],
            "http://www.opengis.net/def/exceptions/ogcapi-processes-1/1.0/result-not-ready");
  const HttpResponse dismissed = Send("DELETE", path);
  EXPECT_EQ(dismissed.status, 200);
  EXPECT_EQ(json::parse(dismissed.body)["status"], "dismissed");
  EXPECT_EQ(CodeOf(Send("GET", path + "/results")), "result-not-available");
  EXPECT_EQ(Send("DELETE", path).status, 200);
  EXPECT_EQ(Send("GET", path).status, 404);
  EXPECT_EQ(FilesLeft(), 0U);
}

}  // namespace
}  // namespace farhorizon

#include "service/handlers/job_wait.h"

#include <chrono>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/handlers_fixture.h"

namespace farhorizon {
namespace {

using nlohmann::json;

class JobWaitTest : public HandlersTest {
 protected:
  std::string Job() { return "/jobs/" + json::parse(Post("/jobs", tiff_).body).value("jobID", ""); }
  // A response may hold on to its request.
  HttpRequest RequestFor(const std::string& job,
                         std::vector<std::pair<std::string, std::string>> headers) {
    HttpRequest request;
    request.method = "GET";
    request.headers = std::move(headers);
    request.parameters = {job.substr(6)};
    return request;
  }
  HandlerContext context() { return {*jobs_, "http://x", 1000}; }
};

TEST_F(JobWaitTest, WaitsUntilTheStatusChanges) {
  const std::string job = Job();
  const HttpRequest request = RequestFor(job, {{"prefer", "wait=5"}});
  const auto response = WaitForJob(context(), request);
  ASSERT_TRUE(response && response->late);
  EXPECT_EQ(response->late->Most(), std::chrono::seconds(5));
  int wakes = 0;
  response->late->Listen([&] { ++wakes; });
  EXPECT_EQ(response->late->Try(false), nullptr);
  EXPECT_EQ(response->late->Try(false), nullptr);
  Send("DELETE", job);
  EXPECT_EQ(wakes, 1);
  const auto answer = response->late->Try(false);
  ASSERT_NE(answer, nullptr);
  EXPECT_EQ(json::parse(answer->body)["status"], "dismissed");
  EXPECT_EQ(FieldOf(*answer, "Preference-Applied"), "wait=5");
}

TEST_F(JobWaitTest, GivesTheOldStatusAtTheEndOfItsTime) {
  const std::string job = Job();
  const HttpRequest request = RequestFor(job, {{"prefer", "wait=1000"}});
  const auto response = WaitForJob(context(), request);
  EXPECT_EQ(response->late->Most(), std::chrono::seconds(60));
  const auto answer = response->late->Try(true);
  ASSERT_NE(answer, nullptr);
  EXPECT_EQ(json::parse(answer->body)["status"], "accepted");
  EXPECT_EQ(FieldOf(*answer, "Preference-Applied"), "wait=60");
}

TEST_F(JobWaitTest, WithATagWaitsForAnyOtherDocument) {
  const std::string job = Job();
  const std::string tag = FieldOf(Send("GET", job), "ETag");
  const HttpRequest same = RequestFor(job, {{"prefer", "wait=5"}, {"if-none-match", tag}});
  const auto waiting = WaitForJob(context(), same);
  EXPECT_EQ(waiting->late->Try(false), nullptr);
  EXPECT_EQ(waiting->late->Try(true)->status, 304);
  const HttpRequest other = RequestFor(job, {{"prefer", "wait=5"}, {"if-none-match", "\"x\""}});
  const auto news = WaitForJob(context(), other)->late->Try(false);
  ASSERT_NE(news, nullptr);
  EXPECT_EQ(news->status, 200);
}

TEST_F(JobWaitTest, NeedsNoWaitWhereNothingIsToCome) {
  const std::string job = Job();
  for (const char* prefer : {"respond-async", "wait=0", "wait=x"}) {
    EXPECT_FALSE(WaitForJob(context(), RequestFor(job, {{"prefer", prefer}}))) << prefer;
  }
  const HttpRequest none =
      RequestFor("/jobs/0190f1e2-0000-7000-8000-000000000000", {{"prefer", "wait=5"}});
  EXPECT_EQ(WaitForJob(context(), none)->late->Try(false)->status, 404);
  Send("DELETE", job);
  const HttpRequest request = RequestFor(job, {{"prefer", "wait=5"}});
  EXPECT_NE(WaitForJob(context(), request)->late->Try(false), nullptr) << "it has ended";
}

}  // namespace
}  // namespace farhorizon

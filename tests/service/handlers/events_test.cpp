#include "service/handlers/events.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/handlers_fixture.h"

namespace farhorizon {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::StartsWith;

class EventsTest : public HandlersTest {
 protected:
  std::string Job() { return "/jobs/" + json::parse(Post("/jobs", tiff_).body).value("jobID", ""); }
  static std::string IdIn(const std::string& text) {
    const std::size_t at = text.find("id: ") + 4;
    return text.substr(at, text.find('\n', at) - at);
  }
};

TEST_F(EventsTest, TellTheStatusAtOnceAndWheneverItChanges) {
  const std::string job = Job();
  const HttpResponse response = Send("GET", job + "/events");
  ASSERT_TRUE(response.events);
  EXPECT_EQ(FieldOf(response, "Content-Type"), "text/event-stream");
  int wakes = 0;
  response.events->Listen([&] { ++wakes; });
  const EventSource::Piece first = response.events->Next();
  EXPECT_FALSE(first.last);
  EXPECT_THAT(first.text, StartsWith("retry: 2000\n\nid: "));
  EXPECT_THAT(first.text, HasSubstr("\nevent: status\ndata: {\"jobID\""));
  EXPECT_EQ(first.text.substr(first.text.size() - 2), "\n\n");
  EXPECT_EQ("\"" + IdIn(first.text) + "\"", FieldOf(Send("GET", job), "ETag"));
  EXPECT_EQ(response.events->Next().text, "") << "nothing has changed";
  EXPECT_EQ(wakes, 0);
  Send("DELETE", job);
  EXPECT_EQ(wakes, 1);
  const EventSource::Piece end = response.events->Next();
  EXPECT_TRUE(end.last);
  EXPECT_THAT(end.text, HasSubstr("\"status\":\"dismissed\""));
}

TEST_F(EventsTest, GoOnFromTheLastOneThatTheClientHas) {
  const std::string job = Job();
  const std::string id = IdIn(Send("GET", job + "/events").events->Next().text);
  const auto resumed = Send("GET", job + "/events", {{"last-event-id", id}});
  EXPECT_EQ(resumed.events->Next().text, "retry: 2000\n\n");
  EXPECT_THAT(Send("GET", job + "/events", {{"last-event-id", "x"}}).events->Next().text,
              HasSubstr("event: status"));
  Send("DELETE", job);
  const std::string last = IdIn(resumed.events->Next().text);
  EXPECT_NE(last, id);
  // A browser that has the last one does not come again.
  EXPECT_EQ(Send("GET", job + "/events", {{"last-event-id", last}}).status, 204);
  EXPECT_EQ(Send("GET", job + "/events", {{"last-event-id", id}}).status, 200);
}

TEST_F(EventsTest, AreOfJobsThatThereAreAndBounded) {
  EXPECT_EQ(CodeOf(Send("GET", "/jobs/x/events")), "no-such-job");
  const std::string job = Job();
  std::vector<HttpResponse> streams;
  for (;;) {
    streams.push_back(Send("GET", job + "/events"));
    if (!streams.back().events) break;
    ASSERT_LE(streams.size(), 512U);
  }
  EXPECT_EQ(streams.back().status, 503);
  EXPECT_EQ(CodeOf(streams.back()), "too-many-connections");
  EXPECT_EQ(streams.size(), 449U) << "one client leaves an eighth to others";
  streams.erase(streams.begin());
  EXPECT_TRUE(Send("GET", job + "/events").events);
  streams.clear();
  EXPECT_EQ(jobs_->CountWatches(), 0);
}

}  // namespace
}  // namespace farhorizon

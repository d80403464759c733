// Waiting for jobs of the real service without asking again and again.
#include <chrono>
#include <signal.h>
#include <string>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/service_fixture.h"

namespace farhorizon {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using Clock = std::chrono::steady_clock;

struct Event {
  std::string id;
  json status;
};

// The events of a body, whose chunks are taken apart first.
std::vector<Event> EventsIn(const std::string& body, bool chunked = true) {
  std::string text;
  for (std::size_t at = 0; chunked && at < body.size();) {
    const std::size_t end = body.find("\r\n", at);
    const std::size_t size = std::stoul(body.substr(at, end - at), nullptr, 16);
    text += body.substr(end + 2, size);
    at = end + 4 + size;
  }
  if (!chunked) text = body;
  std::vector<Event> events;
  for (std::size_t at = 0; (at = text.find("id: ", at)) != std::string::npos;) {
    const std::size_t end = text.find('\n', at);
    const std::size_t data = text.find("data: ", end) + 6;
    events.push_back({text.substr(at + 4, end - at - 4),
                      json::parse(text.substr(data, text.find('\n', data) - data))});
    at = data;
  }
  return events;
}

using EventsE2e = ServiceE2e;

TEST_F(EventsE2e, FollowAJobToItsEnd) {
  StartStandIn();
  const std::string job = Submit("slow.asc");
  const RawAnswer answer = Ask(port_, "GET", job + "/events");
  EXPECT_EQ(answer.status, 200);
  EXPECT_THAT(answer.head, HasSubstr("Content-Type: text/event-stream\r\n"));
  EXPECT_THAT(answer.head, HasSubstr("Transfer-Encoding: chunked\r\n"));
  EXPECT_THAT(answer.head, testing::Not(HasSubstr("Content-Length")));
  EXPECT_EQ(answer.body.substr(answer.body.size() - 7), "\r\n0\r\n\r\n") << "it is whole";
  const std::vector<Event> events = EventsIn(answer.body);
  ASSERT_GE(events.size(), 3U);
  int progress = 0;
  for (const Event& event : events) {
    EXPECT_GE(event.status["progress"], progress);
    progress = event.status["progress"];
  }
  EXPECT_EQ(events.back().status["status"], "successful");
  // Who was cut off before the last one gets that, and who has it nothing.
  const auto from = [&](const Event& event) {
    return Ask(port_, "GET", job + "/events", "Last-Event-ID: " + event.id + "\r\n");
  };
  EXPECT_EQ(EventsIn(from(events.at(1)).body).size(), 1U);
  EXPECT_EQ(from(events.back()).status, 204);
  // HTTP/1.0 has no chunks.
  const RawAnswer old =
      Exchange(port_, "GET " + job + "/events HTTP/1.0\r\nHost: localhost\r\n\r\n");
  EXPECT_EQ(EventsIn(old.body, false).size(), 1U) << old.body;
  EXPECT_EQ(Ask(port_, "HEAD", job + "/events").body, "");
}

TEST_F(EventsE2e, ALongPollIsAnsweredWhenTheStatusChanges) {
  StartStandIn({"FARHORIZON_WORKERS=1"});
  const std::string job = Submit("slow.asc");
  ASSERT_EQ(WaitFor(job, {"running"}), "running");
  const auto start = Clock::now();
  const RawAnswer answer = Ask(port_, "GET", job, "Prefer: wait=30\r\n");
  EXPECT_EQ(json::parse(answer.body)["status"], "successful");
  EXPECT_THAT(answer.head, HasSubstr("Preference-Applied: wait=30\r\n"));
  EXPECT_LT(Clock::now() - start, std::chrono::seconds(15));
  // One that waits for its whole time; the connection goes on after it.
  Submit("hang.asc");
  const std::string waiting = Submit("waits.asc");
  const std::string get = "GET " + waiting + " HTTP/1.1\r\nHost: localhost\r\n";
  const auto before = Clock::now();
  const RawAnswer both = Exchange(
      port_, get + "Prefer: wait=1\r\n\r\n" + get + "Prefer: wait=1\r\nConnection: close\r\n\r\n");
  EXPECT_GE(Clock::now() - before, std::chrono::milliseconds(1900));
  EXPECT_THAT(both.body, HasSubstr("HTTP/1.1 200 OK\r\n")) << "the second answer";
}

TEST_F(EventsE2e, EndWithTheServiceAndLetItStop) {
  StartStandIn({"FARHORIZON_JOBS_DRAIN_SECONDS=0"});
  const std::string job = Submit("hang.asc");
  ASSERT_EQ(WaitFor(job, {"running"}), "running");
  RawAnswer events;
  RawAnswer poll;
  std::thread reader([&] { events = Ask(port_, "GET", job + "/events"); });
  std::thread poller([&] { poll = Ask(port_, "GET", job, "Prefer: wait=60\r\n"); });
  for (int tries = 0; tries < 200; ++tries) {
    const std::string metrics = Ask(port_, "GET", "/metrics").body;
    if (metrics.find("farhorizon_waiting_requests 2") != std::string::npos) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  const auto start = Clock::now();
  service_->Signal(SIGTERM);
  EXPECT_EQ(service_->Wait(), 0);
  EXPECT_LT(Clock::now() - start, std::chrono::seconds(10));
  reader.join();
  poller.join();
  EXPECT_EQ(events.body.substr(events.body.size() - 7), "\r\n0\r\n\r\n");
  EXPECT_EQ(poll.status, 200);
}

TEST_F(EventsE2e, ClientsThatAreGoneLeaveTheirPlaces) {
  StartStandIn({"FARHORIZON_JOBS_MAX_WATCHES=8", "FARHORIZON_WORKERS=1"});
  Submit("hang.asc");
  const std::string job = Submit("waits.asc");
  for (int round = 0; round < 2; ++round) {
    std::vector<int> sockets;
    for (int i = 0; i < 7; ++i) {
      const int fd = Connect(port_);
      const std::string request = "GET " + job + "/events HTTP/1.1\r\nHost: localhost\r\n\r\n";
      ASSERT_EQ(::send(fd, request.data(), request.size(), MSG_NOSIGNAL),
                static_cast<ssize_t>(request.size()));
      char first = 0;
      ASSERT_EQ(::recv(fd, &first, 1, 0), 1);
      std::string head(15, ' ');
      ASSERT_EQ(::recv(fd, head.data(), head.size(), MSG_WAITALL), 15);
      EXPECT_THAT(head, HasSubstr("200")) << "round " << round << ", client " << i;
      sockets.push_back(fd);
    }
    EXPECT_EQ(Ask(port_, "GET", job + "/events").status, 503);
    // A wish that cannot be kept is passed over.
    EXPECT_THAT(Ask(port_, "GET", job, "Prefer: wait=60\r\n").head,
                testing::Not(HasSubstr("Preference-Applied")));
    for (const int fd : sockets) ::close(fd);
    const auto start = Clock::now();
    while (Ask(port_, "GET", "/metrics").body.find("farhorizon_waiting_requests 0") ==
           std::string::npos) {
      ASSERT_LT(Clock::now() - start, std::chrono::seconds(10)) << "before a heartbeat";
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  }
}

}  // namespace
}  // namespace farhorizon

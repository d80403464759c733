// One transfer, against servers on loopback that answer well and badly.
#include "service/outgoing/outgoing_client.h"

#include <cstdlib>
#include <sys/socket.h>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/http_stub.h"

namespace farhorizon {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

class OutgoingClientTest : public testing::Test {
 protected:
  Result<OutgoingResponse> Get(const std::string& url, const std::string& networks = "127.0.0.1",
                               std::vector<std::string> resolve = {}) {
    OutgoingRequest request{*ReadOutgoingUrl(url)};
    request.time = milliseconds(700);
    request.most_bytes = 1000;
    request.resolve = std::move(resolve);
    request.take = [this](std::string_view piece) -> Status {
      body_ += piece;
      return Ok{};
    };
    return SendOutgoing(request, *AddressRules::Read(networks, ""), stop_.get_token());
  }
  std::string KindOf(const std::string& url, const std::string& networks = "127.0.0.1",
                     std::vector<std::string> resolve = {}) {
    const auto response = Get(url, networks, std::move(resolve));
    return response ? std::to_string(response->status) : std::string(response.error().kind);
  }

  HttpStub stub_;
  std::string body_;
  std::stop_source stop_;
};

TEST_F(OutgoingClientTest, GetsABodyAndSendsNothingOfOurs) {
  // None of them may be asked, or given anything.
  for (const char* name : {"http_proxy", "HTTP_PROXY", "https_proxy", "all_proxy", "ALL_PROXY"}) {
    ::setenv(name, "http://127.0.0.1:1/", 1);
  }
  stub_.Answer(HttpStub::Response(200, "heights", "Set-Cookie: a=b\r\n"));
  const auto response = Get(stub_.url("/a?b"));
  for (const char* name : {"http_proxy", "HTTP_PROXY", "https_proxy", "all_proxy", "ALL_PROXY"}) {
    ::unsetenv(name);
  }
  ASSERT_TRUE(response) << response.error().message;
  EXPECT_EQ(response->status, 200);
  EXPECT_EQ(response->bytes, 7);
  EXPECT_EQ(response->address, "127.0.0.1");
  EXPECT_EQ(body_, "heights");
  EXPECT_EQ(Get(stub_.url("/a?b"))->status, 200);
  ASSERT_THAT(stub_.requests(), SizeIs(2));
  EXPECT_EQ(stub_.requests()[1],
            "GET /a?b HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(stub_.port()) +
                "\r\nUser-Agent: farhorizon\r\nAccept: */*\r\n"
                "Accept-Encoding: identity\r\n\r\n");
}

TEST_F(OutgoingClientTest, ConnectsToNoAddressThatIsNotAllowed) {
  stub_.Answer(HttpStub::Response(200, "secret"));
  const std::string port = std::to_string(stub_.port());
  EXPECT_EQ(KindOf(stub_.url(), ""), "href-not-allowed");
  EXPECT_EQ(KindOf("http://localhost:" + port + "/", ""), "href-not-allowed");
  EXPECT_EQ(KindOf("http://[::1]:" + port + "/", ""), "href-not-allowed");
  EXPECT_EQ(KindOf("http://[::ffff:7f00:1]:" + port + "/", ""), "href-not-allowed");
  EXPECT_EQ(KindOf("http://169.254.169.254:" + port + "/", ""), "href-not-allowed");
  EXPECT_EQ(KindOf("http://a.test:" + port + "/", "", {"a.test:" + port + ":127.0.0.1,::1"}),
            "href-not-allowed");
  EXPECT_THAT(stub_.requests(), IsEmpty());
  EXPECT_EQ(stub_.connections(), 0);
}

// What a name means is looked at where the socket is made, each time: a name server that answers
// otherwise the second time gains nothing.
TEST_F(OutgoingClientTest, ANameThatMeansAnotherAddressNowIsJudgedByThat) {
  stub_.Answer(HttpStub::Response(200, "x"));
  const std::string port = std::to_string(stub_.port());
  const std::string url = "http://a.test:" + port + "/";
  EXPECT_EQ(KindOf(url, "127.0.0.1", {"a.test:" + port + ":127.0.0.1"}), "200");
  EXPECT_EQ(KindOf(url, "127.0.0.1", {"a.test:" + port + ":127.0.0.2"}), "href-not-allowed");
  EXPECT_EQ(KindOf(url, "127.0.0.1", {"a.test:" + port + ":127.0.0.2,127.0.0.1"}), "200")
      << "the one that is allowed is taken";
  EXPECT_THAT(stub_.requests(), SizeIs(2));
}

TEST_F(OutgoingClientTest, FollowsNoRedirect) {
  HttpStub other;
  other.Answer(HttpStub::Response(200, "secret"));
  stub_.Answer(HttpStub::Response(302, "moved", "Location: " + other.url("/x") + "\r\n"));
  const auto response = Get(stub_.url());
  ASSERT_TRUE(response);
  EXPECT_EQ(response->status, 302);
  EXPECT_EQ(response->location, other.url("/x"));
  EXPECT_EQ(body_, "");
  EXPECT_EQ(other.connections(), 0);
}

TEST_F(OutgoingClientTest, TakesNoMoreThanItMay) {
  stub_.Answer(HttpStub::Response(200, std::string(1000, 'a')));
  EXPECT_EQ(KindOf(stub_.url()), "200");
  stub_.Answer(HttpStub::Response(200, std::string(1001, 'a')));
  EXPECT_EQ(KindOf(stub_.url()), "body-too-large");
  stub_.Answer("HTTP/1.1 200 X\r\nContent-Length: 99999999999\r\n\r\n");
  EXPECT_EQ(KindOf(stub_.url()), "body-too-large");
  body_.clear();
  stub_.Answer("HTTP/1.1 200 X\r\nConnection: close\r\n\r\n" + std::string(1'000'000, 'a'));
  EXPECT_EQ(KindOf(stub_.url()), "body-too-large") << "without a length";
  stub_.Answer("HTTP/1.1 200 X\r\nTransfer-Encoding: chunked\r\n\r\nfffff\r\n" +
               std::string(1'000'000, 'a'));
  EXPECT_EQ(KindOf(stub_.url()), "body-too-large") << "in pieces";
  EXPECT_LE(body_.size(), 2000U);
}

TEST_F(OutgoingClientTest, SaysWhatIsWrongWithAnAnswer) {
  const std::string head = "HTTP/1.1 200 X\r\n";
  stub_.Answer(HttpStub::Response(200, "\x1f\x8b", "Content-Encoding: gzip\r\n"));
  EXPECT_THAT(Get(stub_.url()).error().message, HasSubstr("gzip"));
  for (const std::string& answer :
       {std::string("SSH-2.0\r\n"), std::string(), std::string("HTTP/1.1 "),
        head + "Content-Length: 20\r\n\r\nshort", head + "A: " + std::string(70'000, 'a') + "\r\n",
        head + "Content-Encoding: gzip\r\nContent-Length: 1\r\n\r\na",
        head + "Transfer-Encoding: chunked\r\n\r\nzz\r\n"}) {
    stub_.Answer(answer);
    EXPECT_EQ(KindOf(stub_.url()), "href-failed") << answer.substr(0, 60);
  }
  stub_.Before([](int client) {
    const struct linger reset { 1, 0 };
    ::setsockopt(client, SOL_SOCKET, SO_LINGER, &reset, sizeof reset);
    return true;
  });
  EXPECT_EQ(KindOf(stub_.url()), "href-failed") << "reset";
  EXPECT_EQ(KindOf("http://127.0.0.1:1/"), "href-failed") << "nobody listens";
  EXPECT_EQ(KindOf("http://no-such-name.invalid/"), "href-failed");
}

TEST_F(OutgoingClientTest, WaitsNoLongerThanItMay) {
  stub_.Before([](int) {
    std::this_thread::sleep_for(milliseconds(1500));
    return true;
  });
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(KindOf(stub_.url()), "href-timeout");
  EXPECT_LT(std::chrono::steady_clock::now() - start, milliseconds(1400));
}

TEST_F(OutgoingClientTest, StopsWhenItIsAskedTo) {
  stub_.Before([this](int) {
    stop_.request_stop();
    std::this_thread::sleep_for(milliseconds(300));
    return false;
  });
  stub_.Answer(HttpStub::Response(200, "x"));
  const auto response = Get(stub_.url());
  ASSERT_FALSE(response);
  EXPECT_EQ(response.error().code, ErrorCode::kCancelled);
}

TEST_F(OutgoingClientTest, ReturnsTheErrorOfWhoTakesTheBody) {
  stub_.Answer(HttpStub::Response(200, "heights"));
  OutgoingRequest request{*ReadOutgoingUrl(stub_.url())};
  request.most_bytes = 10;
  request.take = [](std::string_view) -> Status {
    return Error{ErrorCode::kResourceExhausted, "full", "no-space"};
  };
  const auto response = SendOutgoing(request, *AddressRules::Read("127.0.0.1", ""));
  ASSERT_FALSE(response);
  EXPECT_EQ(response.error().kind, "no-space");
}

TEST_F(OutgoingClientTest, PostsABodyAndReadsNoAnswer) {
  stub_.Answer(HttpStub::Response(201, std::string(100'000, 'a')));
  OutgoingRequest request{*ReadOutgoingUrl(stub_.url("/hook"))};
  request.is_post = true;
  request.body = R"({"a":1})";
  request.headers = {"Content-Type: application/json", "webhook-id: x"};
  const auto response = SendOutgoing(request, *AddressRules::Read("127.0.0.1", ""));
  ASSERT_TRUE(response) << response.error().message;
  EXPECT_EQ(response->status, 201);
  EXPECT_EQ(response->bytes, 0);
  ASSERT_THAT(stub_.requests(), SizeIs(1));
  EXPECT_THAT(stub_.requests()[0], HasSubstr("POST /hook HTTP/1.1\r\n"));
  EXPECT_THAT(stub_.requests()[0], HasSubstr("\r\nwebhook-id: x\r\n"));
  EXPECT_THAT(stub_.requests()[0], testing::EndsWith("\r\n\r\n{\"a\":1}"));
  EXPECT_THAT(stub_.requests()[0], Not(HasSubstr("Expect")));
}

}  // namespace
}  // namespace farhorizon

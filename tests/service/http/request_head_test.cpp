#include "service/http/request_head.h"

#include <string>

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

int StatusOf(const std::string& head) {
  const auto read = ReadRequestHead(head, {});
  const Problem* problem = std::get_if<Problem>(&read);
  return problem == nullptr ? 0 : problem->status;
}

const std::string kHost = "Host: here\r\n";

TEST(RequestHead, ReadsAPlainRequest) {
  auto read =
      ReadRequestHead("GET /jobs?limit=2 HTTP/1.1\r\nHOST: here:80\r\nAccept:  a \r\n\r\n", {});
  ASSERT_TRUE(std::holds_alternative<HttpRequest>(read));
  const HttpRequest& request = std::get<HttpRequest>(read);
  EXPECT_EQ(request.method, "GET");
  EXPECT_EQ(request.path, "/jobs");
  EXPECT_EQ(request.query, "limit=2");
  EXPECT_EQ(*request.Header("accept"), "a");
  EXPECT_TRUE(request.keep_alive);
  EXPECT_FALSE(request.HasBody());
}

TEST(RequestHead, WantsExactlyOneHost) {
  EXPECT_EQ(StatusOf("GET / HTTP/1.1\r\n\r\n"), 400);
  EXPECT_EQ(StatusOf("GET / HTTP/1.1\r\n" + kHost + kHost + "\r\n"), 400);
  EXPECT_EQ(StatusOf("GET / HTTP/1.1\r\nHost: a b\r\n\r\n"), 400);
  EXPECT_EQ(StatusOf("GET / HTTP/1.1\r\n" + kHost + "\r\n"), 0);
}

TEST(RequestHead, TakesTargetsInOriginFormOnly) {
  for (const char* target : {"http://other/", "jobs", "", "/a b", "/\xC3\xA9", "/a#b", "*"}) {
    EXPECT_EQ(StatusOf("GET " + std::string(target) + " HTTP/1.1\r\n" + kHost + "\r\n"), 400)
        << target;
  }
  EXPECT_EQ(StatusOf("GET /" + std::string(9000, 'a') + " HTTP/1.1\r\n" + kHost + "\r\n"), 414);
  EXPECT_EQ(StatusOf("OPTIONS * HTTP/1.1\r\n" + kHost + "\r\n"), 0);
}

TEST(RequestHead, FramesBodiesInOneWayOnly) {
  const auto post = [](const std::string& fields) {
    return StatusOf("POST /jobs HTTP/1.1\r\n" + kHost + fields + "\r\n");
  };
  EXPECT_EQ(post("Content-Length: 5\r\n"), 0);
  EXPECT_EQ(post("Transfer-Encoding: chunked\r\n"), 0);
  EXPECT_EQ(post("Content-Length: 5\r\nTransfer-Encoding: chunked\r\n"), 400);
  EXPECT_EQ(post("Content-Length: 5\r\nContent-Length: 5\r\n"), 400);
  for (const char* length : {"+5", "-5", "5a", "", "5, 5", "0x5", "9999999999999999999"}) {
    EXPECT_EQ(post("Content-Length: " + std::string(length) + "\r\n"), 400) << length;
  }
  for (const char* coding : {"chunked, identity", "identity, chunked", "gzip", "identity"}) {
    EXPECT_EQ(post("Transfer-Encoding: " + std::string(coding) + "\r\n"), 501) << coding;
  }
  EXPECT_EQ(StatusOf("POST / HTTP/1.0\r\nTransfer-Encoding: chunked\r\n\r\n"), 400);
}

TEST(RequestHead, RefusesFieldsThatCanBeReadInTwoWays) {
  for (const char* field : {"X: a\r\n b\r\n", "X : a\r\n", ": a\r\n", "X\r\n", "X: a\x01\r\n",
                            "X: \xFF\r\n", "X: a\nY: b\r\n", "X: a\rb\r\n"}) {
    EXPECT_EQ(StatusOf("GET / HTTP/1.1\r\n" + kHost + field + "\r\n"), 400) << field;
  }
}

TEST(RequestHead, CountsFields) {
  std::string fields;
  for (int i = 0; i < 200; ++i) fields += "X" + std::to_string(i) + ": 1\r\n";
  EXPECT_EQ(StatusOf("GET / HTTP/1.1\r\n" + kHost + fields + "\r\n"), 431);
}

TEST(RequestHead, SpeaksHttp1Only) {
  EXPECT_EQ(StatusOf("GET / HTTP/2.0\r\n" + kHost + "\r\n"), 505);
  EXPECT_EQ(StatusOf("GET / XTTP/1.1\r\n" + kHost + "\r\n"), 400);
  EXPECT_EQ(StatusOf("GET / HTTP/1.1 \r\n" + kHost + "\r\n"), 505);
}

}  // namespace
}  // namespace farhorizon

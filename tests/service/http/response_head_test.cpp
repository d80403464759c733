#include "service/http/response_head.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace farhorizon {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

TEST(ResponseHead, HasTheStatusAndWhatEveryResponseSays) {
  HttpResponse response;
  response.status = 404;
  response.body = "none";
  response.Set("Content-Type", "text/plain");
  const std::string head = ResponseHead({}, response, false, {});
  EXPECT_THAT(head, StartsWith("HTTP/1.1 404 Not Found\r\nContent-Type: text/plain\r\n"));
  EXPECT_THAT(head, HasSubstr("\r\nContent-Length: 4\r\n"));
  EXPECT_THAT(head, HasSubstr("\r\nConnection: close\r\n"));
  EXPECT_THAT(head, HasSubstr("\r\nContent-Security-Policy: default-src 'none'\r\n"));
  EXPECT_THAT(head, Not(HasSubstr("Access-Control")));
  EXPECT_THAT(head, EndsWith("\r\n\r\n"));
}

TEST(ResponseHead, LeavesAPageItsOwnPolicy) {
  HttpResponse page;
  page.Set("Content-Security-Policy", "script-src 'self'");
  const std::string head = ResponseHead({}, page, true, {});
  EXPECT_THAT(head, HasSubstr("script-src 'self'"));
  EXPECT_THAT(head, Not(HasSubstr("default-src 'none'")));
}

TEST(ResponseHead, HasNoLengthWhereNobodyKnowsIt) {
  struct Nothing : EventSource {
    void Listen(std::function<void()> /*wake*/) override {}
    Piece Next() override { return {"", true}; }
  };
  HttpResponse response;
  response.events = std::make_shared<Nothing>();
  const std::string head = ResponseHead({}, response, false, {});
  EXPECT_THAT(head, HasSubstr("Transfer-Encoding: chunked\r\n"));
  EXPECT_THAT(head, Not(HasSubstr("Content-Length")));
  HttpRequest old;
  old.version = 10;
  EXPECT_THAT(ResponseHead(old, response, false, {}), Not(HasSubstr("Transfer-Encoding")));
}

TEST(ResponseHead, HasNoLengthWhereThereIsNoBody) {
  for (const int status : {204, 304}) {
    HttpResponse response;
    response.status = status;
    EXPECT_THAT(ResponseHead({}, response, true, {}), Not(HasSubstr("Content-Length"))) << status;
  }
}

TEST(ResponseHead, NamesOneOriginThatMayReadItAndThatAnswersDiffer) {
  EXPECT_THAT(ResponseHead({}, {}, true, {"*", false}), Not(HasSubstr("Vary")));
  const std::string head = ResponseHead({}, {}, true, {"https://globe.example", true});
  EXPECT_THAT(head, HasSubstr("Access-Control-Allow-Origin: https://globe.example\r\n"));
  EXPECT_THAT(head, HasSubstr("Vary: Origin\r\n"));
  // A cache must not keep for the one what the other got.
  EXPECT_THAT(ResponseHead({}, {}, true, {"", true}), HasSubstr("Vary: Origin\r\n"));
}

TEST(ResponseHead, SaysTheRequestsId) {
  HttpRequest request;
  request.request_id = "abc";
  EXPECT_THAT(ResponseHead(request, {}, true, {}), HasSubstr("X-Request-Id: abc\r\n"));
}

}  // namespace
}  // namespace farhorizon

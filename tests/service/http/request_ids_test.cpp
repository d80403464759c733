#include "service/http/request_ids.h"

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

HttpRequest With(const std::string& name, const std::string& value) {
  HttpRequest request;
  request.headers.emplace_back(name, value);
  return request;
}

TEST(RequestIds, AreTheClientsWhereTheyAreShort) {
  EXPECT_EQ(RequestIdOf(With("x-request-id", "abc")), "abc");
  const std::string made = RequestIdOf(With("x-request-id", std::string(201, 'a')));
  EXPECT_EQ(made.size(), 32U);
  EXPECT_NE(made, RequestIdOf({}));
}

TEST(RequestIds, TheTraceIsThatOfTraceparent) {
  const std::string trace = "4bf92f3577b34da6a3ce929d0e0e4736";
  const std::string rest = "-00f067aa0ba902b7-01";
  EXPECT_EQ(TraceIdOf(With("traceparent", "00-" + trace + rest)), trace);
  EXPECT_EQ(TraceIdOf(With("traceparent", "01-" + trace + rest + "-more")), trace);
  for (const std::string& bad :
       {"00-" + trace + rest + "-more", "ff-" + trace + rest, "00-" + std::string(32, '0') + rest,
        "00-" + trace + "-0000000000000000-01", "00-4BF92F3577B34DA6A3CE929D0E0E4736" + rest,
        std::string("00-"), std::string("x"), "00_" + trace + rest}) {
    EXPECT_EQ(TraceIdOf(With("traceparent", bad)), "") << bad;
  }
  EXPECT_EQ(TraceIdOf({}), "");
}

}  // namespace
}  // namespace farhorizon

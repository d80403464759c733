// The service as a client of others: DEMs by links, calls to subscribers.
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/base64.h"
#include "core/io/sha256.h"
#include "tests/support/http_stub.h"
#include "tests/support/service_fixture.h"

namespace farhorizon {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr const char* kSecret = "0123456789abcdef0123456789abcdef";

class OutgoingE2e : public ServiceE2e {
 protected:
  void StartAllowed(std::vector<std::string> settings = {}) {
    const auto* const bytes = reinterpret_cast<const unsigned char*>(kSecret);
    std::ofstream(folder_ / "secret") << "whsec_" << ToBase64({bytes, 32}) << "\n";
    settings.push_back("FARHORIZON_FETCH_ALLOW=" + other_.url("/dem"));
    settings.push_back("FARHORIZON_FETCH_ALLOW_PRIVATE_ADDRESSES=127.0.0.1");
    settings.push_back("FARHORIZON_CALLBACKS_ALLOW=" + other_.url("/hook"));
    settings.push_back("FARHORIZON_CALLBACKS_ALLOW_PRIVATE_ADDRESSES=127.0.0.1");
    settings.push_back("FARHORIZON_CALLBACKS_SECRET_FILE=" + (folder_ / "secret").string());
    settings.push_back("FARHORIZON_HTTP_MAX_BODY_BYTES=100000");
    StartStandIn(std::move(settings));
  }
  RawAnswer Execute(const json& body, const std::string& headers = "") {
    return Ask(port_, "POST", "/processes/terrain-lod/execution",
               "Content-Type: application/json\r\n" + headers, body.dump());
  }
  [[nodiscard]] json Linked(const std::string& href) const {
    return {{"inputs", {{"dem", {{"href", href}}}, {"crs", "EPSG:4326"}}}};
  }
  static std::string CodeOf(const RawAnswer& answer) {
    return json::parse(answer.body).value("code", answer.body);
  }
  static std::string PathOf(const RawAnswer& answer) {
    EXPECT_EQ(answer.status, 201) << answer.body;
    return "/jobs/" + json::parse(answer.body).value("jobID", "");
  }
  static std::string FieldOf(const std::string& request, const std::string& name) {
    const std::size_t begin = request.find("\r\n" + name + ": ");
    if (begin == std::string::npos) return "";
    const std::size_t from = begin + name.size() + 4;
    return request.substr(from, request.find('\r', from) - from);
  }
  static std::string BodyOf(const std::string& request) {
    return request.substr(request.find("\r\n\r\n") + 4);
  }
  // The calls that have come, once there are so many.
  std::vector<std::string> Calls(std::size_t count) {
    for (int i = 0; i < 500; ++i) {
      std::vector<std::string> calls = other_.requests();
      std::erase_if(calls, [](const std::string& one) { return !one.starts_with("POST /hook"); });
      if (calls.size() >= count) return calls;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return {};
  }

  HttpStub other_;
};

TEST_F(OutgoingE2e, FetchesALinkedDemOnceForAKey) {
  StartAllowed();
  other_.Answer(HttpStub::Response(200, SmallGrid()));
  const json body = Linked(other_.url("/dem/n46.asc?signed=1"));
  const std::string key = "Idempotency-Key: \"k\"\r\n";
  const std::string path = PathOf(Execute(body, key));
  EXPECT_EQ(PathOf(Execute(body, key)), path);
  EXPECT_THAT(other_.requests(), SizeIs(1)) << "the second time it is known";
  EXPECT_EQ(CodeOf(Execute(Linked(other_.url("/dem/n46.asc")), key)), "idempotency-key-reused");
  EXPECT_EQ(WaitForEnd(path), "successful");
  EXPECT_THAT(other_.requests(), SizeIs(1));
}

TEST_F(OutgoingE2e, SaysWhyALinkedDemIsRefusedAndLeavesNothing) {
  StartAllowed();
  const std::string inside = other_.url("/dem/a.asc");
  EXPECT_EQ(CodeOf(Execute(Linked(other_.url("/other")))), "href-not-allowed");
  EXPECT_EQ(CodeOf(Execute(Linked(other_.url("/dem/../other")))), "href-not-allowed");
  EXPECT_EQ(CodeOf(Execute(Linked("file:///etc/passwd"))), "href-not-allowed");
  EXPECT_THAT(other_.requests(), IsEmpty());
  other_.Answer(HttpStub::Response(302, "", "Location: " + other_.url("/secret") + "\r\n"));
  RawAnswer answer = Execute(Linked(inside));
  EXPECT_EQ(answer.status, 502);
  EXPECT_THAT(answer.body, HasSubstr("/secret"));
  other_.Answer(HttpStub::Response(200, std::string(100'001, '1')));
  EXPECT_EQ(CodeOf(Execute(Linked(inside))), "body-too-large");
  other_.Answer(HttpStub::Response(200, "<html>"));
  EXPECT_EQ(CodeOf(Execute(Linked(inside))), "not-a-raster");
  other_.Answer(HttpStub::Response(404, "x"));
  EXPECT_EQ(CodeOf(Execute(Linked(inside))), "href-failed");
  EXPECT_THAT(other_.requests(), SizeIs(4)) << "no redirect was followed";
  EXPECT_EQ(LeftOver("spool"), 0U);
}

TEST_F(OutgoingE2e, CallsSubscribersSigned) {
  StartAllowed();
  EXPECT_THAT(Ask(port_, "GET", "/conformance").body, HasSubstr("conf/callback"));
  other_.Answer(HttpStub::Response(200, SmallGrid()));
  json body = Linked(other_.url("/dem/a.asc"));
  body["subscriber"] = {{"successUri", "http://127.0.0.1/hook"}};
  EXPECT_EQ(CodeOf(Execute(body)), "callback-not-allowed");
  body["subscriber"] = {{"successUri", other_.url("/hook/done")}, {"x", "y"}};
  EXPECT_EQ(CodeOf(Execute(body)), "invalid-parameter");
  EXPECT_THAT(other_.requests(), IsEmpty()) << "nothing is fetched before";
  body["subscriber"] = {{"successUri", other_.url("/hook/done")}};
  const std::string path = PathOf(Execute(body));
  const std::vector<std::string> calls = Calls(1);
  ASSERT_THAT(calls, SizeIs(1));
  const std::string& call = calls[0];
  EXPECT_THAT(call, testing::StartsWith("POST /hook/done HTTP/1.1\r\n"));
  EXPECT_EQ(FieldOf(call, "Content-Type"), "application/json");
  EXPECT_EQ(FieldOf(call, "webhook-id"), path.substr(6) + "-success");
  const std::string said =
      FieldOf(call, "webhook-id") + "." + FieldOf(call, "webhook-timestamp") + "." + BodyOf(call);
  EXPECT_EQ(FieldOf(call, "webhook-signature"), "v1," + HmacSha256(kSecret, said).Base64());
  EXPECT_EQ(json::parse(BodyOf(call)), json::parse(Ask(port_, "GET", path + "/results").body));
}

TEST_F(OutgoingE2e, CallsAgainAfterAKillWithTheSameId) {
  StartAllowed();
  other_.AnswerEach({HttpStub::Response(200, SmallGrid()), HttpStub::Response(500)});
  json body = Linked(other_.url("/dem/a.asc"));
  body["subscriber"] = {{"successUri", other_.url("/hook")}, {"failedUri", other_.url("/hook")}};
  const std::string path = PathOf(Execute(body));
  const std::vector<std::string> first = Calls(1);
  ASSERT_FALSE(first.empty());
  service_->Signal(SIGKILL);
  service_->Wait();
  other_.Answer(HttpStub::Response(204));
  const std::size_t before = Calls(1).size();
  StartAllowed();
  const std::vector<std::string> calls = Calls(before + 1);
  ASSERT_GT(calls.size(), before);
  EXPECT_EQ(FieldOf(calls.back(), "webhook-id"), FieldOf(first[0], "webhook-id"));
  EXPECT_EQ(BodyOf(calls.back()).find("\"status\":\"failed\""), std::string::npos);
  EXPECT_THAT(Ask(port_, "GET", "/metrics").body, HasSubstr("farhorizon_callbacks_total"));
}

TEST_F(OutgoingE2e, BothAreOffAsItComes) {
  StartStandIn();
  const RawAnswer link = Execute(Linked(other_.url("/dem/a.asc")));
  EXPECT_EQ(link.status, 403);
  EXPECT_THAT(link.body, HasSubstr("fetch.allow"));
  json body = {{"inputs", {{"dem", "SUkqAA=="}}}};
  body["subscriber"] = {{"successUri", other_.url("/hook")}};
  const RawAnswer call = Execute(body);
  EXPECT_EQ(call.status, 403);
  EXPECT_THAT(call.body, HasSubstr("callbacks.allow"));
  EXPECT_THAT(Ask(port_, "GET", "/conformance").body, testing::Not(HasSubstr("conf/callback")));
  EXPECT_THAT(other_.requests(), IsEmpty());
}

}  // namespace
}  // namespace farhorizon

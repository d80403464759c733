#include "service/http/access_rules.h"

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

HttpRequest Request(const std::string& method, const std::string& host,
                    const std::string& origin = "") {
  HttpRequest request;
  request.method = method;
  if (!host.empty()) request.headers.emplace_back("host", host);
  if (!origin.empty()) request.headers.emplace_back("origin", origin);
  return request;
}

int StatusOfRule(const HttpRequest& request, const AccessRules& rules = {}) {
  const std::optional<Problem> problem = CheckAccess(request, rules);
  return problem ? problem->status : 200;
}

TEST(AccessRules, AnAddressOrANameThatNobodyCanRegisterMayStandInHost) {
  for (const char* host :
       {"127.0.0.1:8080", "10.1.2.3", "[::1]:8080", "[fe80::1%eth0]", "localhost", "LOCALHOST:8080",
        "tiles.localhost", "farhorizon:8080", "localhost."}) {
    EXPECT_EQ(StatusOfRule(Request("GET", host)), 200) << host;
  }
  EXPECT_EQ(StatusOfRule(Request("GET", "")), 200);  // HTTP/1.0 has no Host
}

TEST(AccessRules, AnyOtherNameMustBeConfigured) {
  for (const char* host :
       {"evil.example", "evil.example:8080", "127.0.0.1.evil.example", "evil.example.",
        "localhost.evil.example", ".localhost", "1.2.3", "[evil.example]", "0x7f.1"}) {
    EXPECT_EQ(StatusOfRule(Request("GET", host)), 421) << host;
  }
  const AccessRules rules =
      ReadAccessRules("https://Tiles.example/dem/", "a.example, B.example", "");
  for (const char* host : {"tiles.example", "TILES.example:443", "a.example:8080", "b.example"}) {
    EXPECT_EQ(StatusOfRule(Request("GET", host), rules), 200) << host;
  }
  EXPECT_EQ(StatusOfRule(Request("GET", "c.example"), rules), 421);
}

TEST(AccessRules, APageOfAnotherOriginMayChangeNothing) {
  for (const char* origin :
       {"https://evil.example", "null", "http://127.0.0.1:8081", "http://localhost:8080", "file://",
        "http://127.0.0.1:8080.evil.example"}) {
    for (const char* method : {"POST", "DELETE", "OPTIONS", "PUT"}) {
      EXPECT_EQ(StatusOfRule(Request(method, "127.0.0.1:8080", origin)), 403) << method << origin;
    }
    const HttpRequest get = Request("GET", "127.0.0.1:8080", origin);
    EXPECT_EQ(StatusOfRule(get), 200);
    EXPECT_EQ(CorsOf(get, {}).readable_by, "");
  }
}

TEST(AccessRules, TheServicesOwnPagesMay) {
  EXPECT_EQ(StatusOfRule(Request("POST", "127.0.0.1:8080", "http://127.0.0.1:8080")), 200);
  EXPECT_EQ(StatusOfRule(Request("POST", "LocalHost:80", "http://localhost")), 200);
  // A proxy that speaks TLS passes Host on.
  EXPECT_EQ(StatusOfRule(Request("POST", "localhost", "https://localhost")), 200);
  // One that changes Host: the public URL says what its pages' origin is.
  const AccessRules rules = ReadAccessRules("https://tiles.example/dem", "", "");
  EXPECT_EQ(StatusOfRule(Request("POST", "10.0.0.5:8080", "https://tiles.example"), rules), 200);
}

TEST(AccessRules, ConfiguredOriginsMayAndOnlyTheyRead) {
  const AccessRules rules = ReadAccessRules("", "", "http://localhost:3000, https://globe.example");
  const HttpRequest mine = Request("POST", "127.0.0.1:8080", "https://globe.example");
  EXPECT_EQ(StatusOfRule(mine, rules), 200);
  EXPECT_EQ(CorsOf(mine, rules).readable_by, "https://globe.example");
  EXPECT_TRUE(CorsOf(mine, rules).depends_on_origin);
  const HttpRequest other = Request("GET", "127.0.0.1:8080", "https://globe.example.evil");
  EXPECT_EQ(CorsOf(other, rules).readable_by, "");
  const AccessRules all = ReadAccessRules("", "", "*");
  EXPECT_EQ(StatusOfRule(Request("DELETE", "127.0.0.1:8080", "null"), all), 200);
  EXPECT_EQ(CorsOf(Request("GET", "127.0.0.1:8080"), all).readable_by, "*");
}

}  // namespace
}  // namespace farhorizon

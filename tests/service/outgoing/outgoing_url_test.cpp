#include "service/outgoing/outgoing_url.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace farhorizon {
namespace {

constexpr const char* kPrefixes =
    "https://tiles.example.org/tiles, http://store:9000/, https://[2606:4700::1]/, "
    "http://127.0.0.1:8000/a/";

// "yes", "no", or why the URL cannot be read.
std::string Allowed(const std::string& text) {
  const auto prefixes = UrlPrefixes::Read(kPrefixes, "fetch.allow");
  EXPECT_TRUE(prefixes);
  const auto url = ReadOutgoingUrl(text);
  if (!url) {
    EXPECT_EQ(url.error().kind, "href-not-allowed");
    return url.error().message;
  }
  return prefixes->Have(*url) ? "yes" : "no";
}

TEST(OutgoingUrl, IsAllowedWhereItContinuesAPrefix) {
  for (const char* url :
       {"https://tiles.example.org/tiles", "https://tiles.example.org/tiles/n46.tif",
        "https://tiles.example.org/tiles/a/b%20c.tif?X-Amz-Signature=0%2F1&b=",
        "https://tiles.example.org/tiles?n=46", "http://store:9000", "http://store:9000/x",
        "http://store:9000/?a", "https://[2606:4700::1]/x", "http://127.0.0.1:8000/a/b",
        "https://tiles.example.org/tiles/..hidden/a..b"}) {
    EXPECT_EQ(Allowed(url), "yes") << url;
  }
}

TEST(OutgoingUrl, IsNotAllowedElsewhere) {
  for (const char* url :
       {"http://tiles.example.org/tiles/a", "https://tiles.example.org/", "https://evil.com/tiles",
        "https://tiles.example.org/tilesX", "https://tiles.example.org.evil.com/tiles/a",
        "https://xtiles.example.org/tiles/a", "https://tiles.example.org:444/tiles/a",
        "https://tiles.example.org/TILES/a", "http://store/x", "http://store:90000",
        "http://store:0", "http://127.0.0.1:8000/a", "http://127.0.0.1/a/b",
        "http://169.254.169.254/latest/meta-data", "http://[::1]/", "http://[::ffff:7f00:1]/",
        "http://[::ffff:127.0.0.1]:8000/a/b", "https://tiles.example.org?/tiles"}) {
    EXPECT_NE(Allowed(url), "yes") << url;
  }
}

TEST(OutgoingUrl, IsRefusedWhereItCouldBeReadInTwoWays) {
  for (const char* url :
       {// other schemes, or none
        "file:///etc/passwd", "gopher://store:9000/", "ftp://store:9000/", "dict://store:9000/",
        "store:9000/x", "//store:9000/x", "/x", "", "http:", "http://", "http:store:9000",
        "http:///store:9000/", "http:/store:9000/", "https:\\\\store:9000/", "javascript:alert(1)",
        "data:,x",
        // user names, and what is meant to look like a host
        "https://tiles.example.org@evil.com/tiles/a", "https://tiles.example.org:x@evil.com/tiles",
        "https://a@tiles.example.org/tiles/a", "https://@tiles.example.org/tiles/a",
        "https://tiles.example.org\\@evil.com/tiles", "https://evil.com\\tiles.example.org/tiles",
        "https://evil.com#@tiles.example.org/tiles", "https://tiles.example.org/tiles#a",
        // odd forms of hosts and ports
        "http://2130706433:8000/a/b", "http://0x7f.1:8000/a/b", "http://017700000001:8000/a/b",
        "http://127.1:8000/a/b", "http://0x7f000001:8000/a/b", "http://127.0.0.1.:8000/a/b",
        "http://127.000.000.001:8000/a/b", "http://localhost./", "http://store.:9000/",
        "http://STORE:9000/", "HTTP://store:9000/", "http://store:09000/x", "http://%73tore:9000/",
        "http://store%2e:9000/", "https://tiles.example.org:443/tiles/a",
        "https://tiles.example.org:/tiles/a", "http://[fe80::1%25eth0]/", "http://[::1]x/",
        "https://tiles\xc3\xa9.example.org/tiles", "https://tiles.example.org\xef\xbc\x8ftiles/a",
        "http://store:9000 /",
        // paths that a server may resolve
        "https://tiles.example.org/tiles/../secret", "https://tiles.example.org/tiles/./a",
        "https://tiles.example.org/tiles/..", "https://tiles.example.org/tiles/.",
        "https://tiles.example.org/tiles/%2e%2e/secret",
        "https://tiles.example.org/tiles/%2E%2E/secret",
        "https://tiles.example.org/tiles/.%2e/secret",
        "https://tiles.example.org/tiles/..%2fsecret",
        "https://tiles.example.org/tiles/..%5csecret", "https://tiles.example.org/tiles/..\\secret",
        "https://tiles.example.org/tiles/%252e%252e/secret", "https://tiles.example.org/tiles%2fa",
        "https://tiles.example.org/tiles/a%00.tif", "https://tiles.example.org/tiles/a%0d%0aX: y",
        "https://tiles.example.org/tiles/a\r\nX: y", "https://tiles.example.org/tiles/a b",
        "https://tiles.example.org/tiles/a\tb", "https://tiles.example.org/tiles/..;/secret",
        "https://tiles.example.org/tiles/.;x=1/a", "https://tiles.example.org/tiles/%",
        "https://tiles.example.org/tiles/%4", "https://tiles.example.org/tiles/%zz",
        "https://tiles.example.org/tiles/%4g"}) {
    const std::string answer = Allowed(url);
    EXPECT_TRUE(answer != "yes" && answer != "no") << url << ": " << answer;
  }
  for (const char* odd : {"HTTP://store:9000/x", "http://STORE:9000/x", "http://store.:9000/x"}) {
    EXPECT_THAT(Allowed(odd), testing::EndsWith("which is http://store:9000")) << odd;
  }
  EXPECT_THAT(Allowed("http://store:9000/" + std::string(5000, 'a')), testing::HasSubstr("4096"));
  EXPECT_THAT(Allowed(std::string("http://store:9000/a\0b", 21)), testing::HasSubstr("blank"));
}

TEST(UrlPrefixes, AreReadStrictly) {
  EXPECT_TRUE(UrlPrefixes::Read("", "fetch.allow")->empty());
  for (const char* list : {"store", "ftp://store/", "http://store/?a", "http://store/#a",
                           "http://a@store/", "*", "https://*/x/../y", "http://store/%2e"}) {
    const auto read = UrlPrefixes::Read(list, "fetch.allow");
    ASSERT_FALSE(read) << list;
    EXPECT_EQ(read.error().kind, "invalid-config");
    EXPECT_THAT(read.error().message, testing::HasSubstr("fetch.allow has"));
  }
}

}  // namespace
}  // namespace farhorizon

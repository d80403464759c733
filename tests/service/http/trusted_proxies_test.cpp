#include "service/http/trusted_proxies.h"

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

std::string ClientSeen(const std::string& trusted, const std::string& peer,
                       const std::vector<std::string>& fields) {
  HttpRequest request;
  for (const std::string& field : fields) request.headers.emplace_back("x-forwarded-for", field);
  return TrustedProxies::Read(trusted)->ClientOf(request, peer);
}

TEST(TrustedProxies, NobodyElseNamesAClient) {
  EXPECT_EQ(ClientSeen("", "192.0.2.1", {"198.51.100.7"}), "192.0.2.1");
  EXPECT_EQ(ClientSeen("127.0.0.1", "192.0.2.1", {"198.51.100.7"}), "192.0.2.1");
  EXPECT_EQ(ClientSeen("192.0.2.0/24", "192.0.3.1", {"198.51.100.7"}), "192.0.3.1");
}

TEST(TrustedProxies, NameTheLastThatIsNone) {
  EXPECT_EQ(ClientSeen("127.0.0.1", "127.0.0.1", {"198.51.100.7"}), "198.51.100.7");
  EXPECT_EQ(ClientSeen("127.0.0.1", "127.0.0.1", {"6.6.6.6, 198.51.100.7"}), "198.51.100.7")
      << "what stands before was sent by the client";
  EXPECT_EQ(ClientSeen("127.0.0.1,10.0.0.0/8", "127.0.0.1", {"6.6.6.6", "198.51.100.7, 10.1.2.3"}),
            "198.51.100.7");
  EXPECT_EQ(ClientSeen("::1", "::1", {"2001:db8::7"}), "2001:db8::7");
  EXPECT_EQ(ClientSeen("127.0.0.1", "::ffff:127.0.0.1", {"198.51.100.7"}), "198.51.100.7");
}

TEST(TrustedProxies, WithoutAnAddressTheClientIsThePeer) {
  for (const char* field : {"", "unknown", "1.2.3.4:80", "\x1b[31m", "127.0.0.1"}) {
    EXPECT_EQ(ClientSeen("127.0.0.1", "127.0.0.1", {field}), "127.0.0.1") << field;
  }
  EXPECT_EQ(ClientSeen("127.0.0.1", "127.0.0.1", {}), "127.0.0.1");
}

TEST(TrustedProxies, AreAddressesAndNetworks) {
  for (const char* list :
       {"proxy", "10.0.0.0/33", "10.0.0.0/", "10.0.0/8", "::1/129", "1.2.3.4/-1"}) {
    EXPECT_FALSE(TrustedProxies::Read(list)) << list;
  }
  const auto some = TrustedProxies::Read("10.16.0.0/12, 2001:db8::/33, 192.0.2.1");
  ASSERT_TRUE(some);
  for (const char* address : {"10.16.0.1", "10.31.255.255", "2001:db8:7fff::1", "192.0.2.1"}) {
    EXPECT_TRUE(some->Has(address)) << address;
  }
  for (const char* address : {"10.32.0.0", "10.15.0.1", "2001:db8:8000::1", "192.0.2.2", "x", ""}) {
    EXPECT_FALSE(some->Has(address)) << address;
  }
}

}  // namespace
}  // namespace farhorizon

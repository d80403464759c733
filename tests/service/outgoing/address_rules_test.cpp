#include "service/outgoing/address_rules.h"

#include <gtest/gtest.h>

namespace farhorizon {
namespace {

bool Allow(const std::string& address, const std::string& networks = "") {
  const auto bytes = ReadIpAddress(address);
  EXPECT_TRUE(bytes) << address;
  return AddressRules::Read(networks, "fetch.allowPrivateAddresses")->Allow(*bytes);
}

TEST(AddressRules, AllowWhatIsPublic) {
  for (const char* address :
       {"1.1.1.1", "93.184.216.34", "100.63.255.255", "100.128.0.1", "172.15.255.255", "172.32.0.1",
        "192.0.1.1", "223.255.255.255", "2606:4700::1111", "2a00:1450:4001::1",
        "::ffff:93.184.216.34", "64:ff9b::93.184.216.34", "2002:5db8:d822::1"}) {
    EXPECT_TRUE(Allow(address)) << address;
  }
}

TEST(AddressRules, RefuseWhatIsNot) {
  for (const char* address :
       {"0.0.0.0", "0.1.2.3", "10.0.0.1", "100.64.0.1", "100.127.255.255", "127.0.0.1",
        "127.255.0.3", "169.254.169.254", "172.16.0.1", "172.31.255.255", "192.0.0.8", "192.0.2.1",
        "192.88.99.1", "192.168.1.1", "198.18.0.1", "198.19.255.255", "198.51.100.1", "203.0.113.1",
        "224.0.0.1", "239.255.255.255", "240.0.0.1", "255.255.255.255",
        // IPv6, and forms of the above within it
        "::", "::1", "::127.0.0.1", "::ffff:127.0.0.1", "::ffff:169.254.169.254", "::ffff:10.0.0.1",
        "64:ff9b::127.0.0.1", "64:ff9b::a9fe:a9fe", "64:ff9b:1::1", "2002:7f00:1::",
        "2002:a9fe:a9fe::1", "2002:c0a8:101::1", "fc00::1", "fd12:3456::1", "fe80::1", "fec0::1",
        "ff02::1", "2001::1", "2001:db8::1", "3fff::1", "100::1", "4000::1"}) {
    EXPECT_FALSE(Allow(address)) << address;
  }
}

TEST(AddressRules, AllowTheNetworksThatTheOperatorNames) {
  EXPECT_TRUE(Allow("10.1.2.3", "10.1.0.0/16, ::1"));
  EXPECT_FALSE(Allow("10.2.2.3", "10.1.0.0/16, ::1"));
  EXPECT_TRUE(Allow("::1", "10.1.0.0/16, ::1"));
  EXPECT_TRUE(Allow("::ffff:10.1.2.3", "10.1.0.0/16"));
  EXPECT_TRUE(Allow("64:ff9b::10.1.2.3", "10.1.0.0/16"));
  EXPECT_TRUE(Allow("1.1.1.1", "10.1.0.0/16"));
}

TEST(AddressRules, SayWhichKeyCannotBeRead) {
  const auto rules = AddressRules::Read("10.0.0.0/99", "fetch.allowPrivateAddresses");
  ASSERT_FALSE(rules);
  EXPECT_EQ(rules.error().kind, "invalid-config");
  EXPECT_NE(rules.error().message.find("fetch.allowPrivateAddresses"), std::string::npos);
}

}  // namespace
}  // namespace farhorizon

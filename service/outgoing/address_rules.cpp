// What is not on the public internet, by the registries of special-purpose addresses of IANA
// [RFC 6890]: whatever is added there later, an address outside 2000::/3 stays refused.
#include "service/outgoing/address_rules.h"

#include <algorithm>
#include <utility>

namespace farhorizon {

namespace {

// This host, private, CGNAT, loopback, link-local, protocol assignments, documentation, the relays
// of 6to4, benchmarks, multicast and all above it.
constexpr const char* kSpecial4 =
    "0.0.0.0/8, 10.0.0.0/8, 100.64.0.0/10, 127.0.0.0/8, 169.254.0.0/16, 172.16.0.0/12, "
    "192.0.0.0/24, 192.0.2.0/24, 192.88.99.0/24, 192.168.0.0/16, 198.18.0.0/15, 198.51.100.0/24, "
    "203.0.113.0/24, 224.0.0.0/3";
// Of the addresses that are global unicast: protocol assignments with Teredo, documentation.
constexpr const char* kSpecial6 = "2001::/23, 2001:db8::/32, 3fff::/20";

IpNetworks Networks(const char* list) {
  Result<IpNetworks> networks = IpNetworks::Read(list, "");
  Check(networks.has_value(), "the lists above can be read");
  return *std::move(networks);
}

// Whether `address` is of IPv4.
bool IsFour(const IpAddress& address) {
  static const IpNetworks mapped = Networks("::ffff:0:0/96");
  return mapped.Has(address);
}

// The address of IPv4 whose bytes begin at `from`.
IpAddress FourAt(const IpAddress& address, std::size_t from) {
  IpAddress four{};
  four[10] = four[11] = 0xFF;
  std::copy_n(address.begin() + static_cast<std::ptrdiff_t>(from), 4, four.begin() + 12);
  return four;
}

// The address where the packets go in the end [RFC 6052], [RFC 3056].
IpAddress Unwrapped(const IpAddress& address) {
  static const IpNetworks nat64 = Networks("64:ff9b::/96");
  static const IpNetworks six_to_four = Networks("2002::/16");
  if (nat64.Has(address)) return FourAt(address, 12);
  if (six_to_four.Has(address)) return FourAt(address, 2);
  return address;
}

bool IsPublic(const IpAddress& address) {
  static const IpNetworks special4 = Networks(kSpecial4);
  static const IpNetworks special6 = Networks(kSpecial6);
  static const IpNetworks unicast = Networks("2000::/3");
  if (IsFour(address)) return !special4.Has(address);
  return unicast.Has(address) && !special6.Has(address);
}

}  // namespace

Result<AddressRules> AddressRules::Read(const std::string& private_networks,
                                        const std::string& key) {
  Result<IpNetworks> networks = IpNetworks::Read(private_networks, key);
  if (!networks) return std::move(networks.error());
  AddressRules rules;
  rules.private_networks_ = *std::move(networks);
  return rules;
}

bool AddressRules::Allow(const IpAddress& address) const {
  const IpAddress end = Unwrapped(address);
  return IsPublic(end) || private_networks_.Has(end);
}

}  // namespace farhorizon

#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace farhorizon {

/// An address as sixteen bytes; one of IPv4 as ::ffff:a.b.c.d.
using IpAddress = std::array<unsigned char, 16>;

/// The address that `text` is: four decimal numbers, or IPv6; nullopt for any other text.
std::optional<IpAddress> ReadIpAddress(const std::string& text);
/// "192.0.2.1", "2001:db8::1".
std::string IpAddressText(const IpAddress& address);

/// A set of addresses and networks.
/// Threads: safe once made.
class IpNetworks {
 public:
  /// list: addresses and networks with commas, "127.0.0.1, 10.0.0.0/8, ::1". key: of the
  /// configuration, whose value it is.
  /// Errors: kInvalidArgument "invalid-config".
  static Result<IpNetworks> Read(const std::string& list, const std::string& key);

  [[nodiscard]] bool Has(const IpAddress& address) const;

 private:
  struct Network {
    IpAddress bytes;
    unsigned bits;
  };
  std::vector<Network> networks_;
};

}  // namespace farhorizon

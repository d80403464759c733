#pragma once

#include <string>

#include "core/base/result.h"
#include "service/ip_networks.h"

namespace farhorizon {

/// Which addresses the service connects to on behalf of a client: those of the public internet, and
/// those of the networks that the operator has named.
/// Threads: safe.
class AddressRules {
 public:
  /// private_networks: as IpNetworks::Read takes it. key: whose value it is.
  /// Errors: kInvalidArgument "invalid-config".
  static Result<AddressRules> Read(const std::string& private_networks, const std::string& key);

  /// An address that carries one of IPv4 (mapped, by NAT64 or 6to4) is judged by that.
  [[nodiscard]] bool Allow(const IpAddress& address) const;

 private:
  IpNetworks private_networks_;
};

}  // namespace farhorizon

#pragma once

#include <string>

#include "core/base/result.h"
#include "service/handlers/http_message.h"
#include "service/ip_networks.h"

namespace farhorizon {

/// The proxies whose word counts for the address of a client. From anybody else the field
/// X-Forwarded-For says nothing: everybody can send it.
class TrustedProxies {
 public:
  /// list: addresses and networks with commas, "127.0.0.1, 10.0.0.0/8, ::1".
  /// Errors: kInvalidArgument "invalid-config".
  static Result<TrustedProxies> Read(const std::string& list);

  [[nodiscard]] bool Has(const std::string& address) const;

  /// The address of the client of a request that came from `peer`: that of the peer itself, unless
  /// it is a trusted proxy; then the last one of X-Forwarded-For that is none, if it is an address.
  [[nodiscard]] std::string ClientOf(const HttpRequest& request, const std::string& peer) const;

 private:
  IpNetworks networks_;
};

}  // namespace farhorizon

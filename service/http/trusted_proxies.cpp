#include "service/http/trusted_proxies.h"

#include <optional>
#include <utility>
#include <vector>

#include "service/text_list.h"

namespace farhorizon {

Result<TrustedProxies> TrustedProxies::Read(const std::string& list) {
  Result<IpNetworks> networks = IpNetworks::Read(list, "http.trustedProxies");
  if (!networks) return std::move(networks.error());
  TrustedProxies proxies;
  proxies.networks_ = *std::move(networks);
  return proxies;
}

bool TrustedProxies::Has(const std::string& address) const {
  const std::optional<IpAddress> bytes = ReadIpAddress(address);
  return bytes && networks_.Has(*bytes);
}

std::string TrustedProxies::ClientOf(const HttpRequest& request, const std::string& peer) const {
  if (!Has(peer)) return peer;
  std::vector<std::string> path;
  for (const auto& [name, value] : request.headers) {
    if (name != "x-forwarded-for") continue;
    for (std::string& address : CommaList(value)) path.push_back(std::move(address));
  }
  while (!path.empty() && Has(path.back())) path.pop_back();
  return path.empty() || !ReadIpAddress(path.back()) ? peer : path.back();
}

}  // namespace farhorizon
